// Holds the properties of a problem by the names that the filters use: the user's values, with the
// default and the range of each.
#ifndef GridFEM_Properties_h
#define GridFEM_Properties_h

#include <map>
#include <string>

namespace gridfem
{

struct Property
{
  double standard; // the default
  double least;    // values outside of [least, most] are taken as the nearer of these
  double most;
};

/// The properties that the user gives. A problem asks for each of its properties once, and then
/// checks that there are no others.
class Properties
{
public:
  /// @param owner  the owner of the properties, for messages
  Properties(std::string owner, std::map<std::string, double> given)
    : owner_(std::move(owner)), given_(std::move(given))
  {
  }

  ///@{ Return the given value, else the default. Throw InvalidInput if it is out of range, or no
  /// integer where one is needed.
  double Number(const std::string& name, double standard, double least, double most);
  int Integer(const std::string& name, int standard, int least, int most);
  bool Switch(const std::string& name, bool standard);
  ///@}

  /// Throws InvalidInput naming the first property that the problem has not asked for.
  void RequireNoOther() const;

  /// The properties that the problem has asked for.
  const std::map<std::string, Property>& Known() const { return known_; }

private:
  double Take(const std::string& name, const Property& property);

  std::string owner_;
  std::map<std::string, double> given_;
  std::map<std::string, Property> known_;
};

} // namespace gridfem

#endif
