// The properties of a problem by their names, as the filters have them: what a user gives, with the
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

/// A problem asks for each of its properties once, and then that there are no others.
class Properties
{
public:
  /// @param owner  whose properties they are, for messages
  Properties(std::string owner, std::map<std::string, double> given)
    : owner_(std::move(owner)), given_(std::move(given))
  {
  }

  ///@{ What was given, else the default. Throws InvalidInput when it is no number, or no integer
  /// where one is needed.
  double Number(const std::string& name, double standard, double least, double most);
  int Integer(const std::string& name, int standard, int least, int most);
  bool Switch(const std::string& name, bool standard);
  ///@}

  ///@{ The same without a nearest value: throws InvalidInput for what is out of range.
  double NumberFrom(const std::string& name, double standard, double least);
  double FiniteNumber(const std::string& name, double standard);
  ///@}

  /// Throws InvalidInput naming the first that nobody has asked for.
  void RequireNoOther() const;

  /// All that were asked for.
  const std::map<std::string, Property>& Known() const { return known_; }

private:
  double Take(const std::string& name, const Property& property);

  std::string owner_;
  std::map<std::string, double> given_;
  std::map<std::string, Property> known_;
};

} // namespace gridfem

#endif
