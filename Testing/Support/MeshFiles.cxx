// Reads only the kinds of files in the folder of real meshes.
#include "Meshes.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

namespace gridfem::testing
{

namespace
{

[[noreturn]] void Fail(const std::string& path, const std::string& why)
{
  throw std::runtime_error(path + ": " + why);
}

void AddFan(TriangleMesh& mesh, const std::vector<Id>& polygon)
{
  for (std::size_t k = 2; k < polygon.size(); ++k)
  {
    mesh.triangles.push_back({ polygon[0], polygon[k - 1], polygon[k] });
  }
}

void AddSoupTriangles(TriangleMesh& mesh)
{
  for (Id first = 0; first + 2 < static_cast<Id>(mesh.points.size()); first += 3)
  {
    mesh.triangles.push_back({ first, first + 1, first + 2 });
  }
}

/// Reads little-endian numbers, one after the other.
class ByteReader
{
public:
  ByteReader(const std::string& bytes, std::size_t position) : bytes_(bytes), position_(position) {}

  double Next(const std::string& type)
  {
    if (type == "char" || type == "int8")
    {
      return this->As<std::int8_t>();
    }
    if (type == "uchar" || type == "uint8")
    {
      return this->As<std::uint8_t>();
    }
    if (type == "short" || type == "int16")
    {
      return this->As<std::int16_t>();
    }
    if (type == "ushort" || type == "uint16")
    {
      return this->As<std::uint16_t>();
    }
    if (type == "int" || type == "int32")
    {
      return this->As<std::int32_t>();
    }
    if (type == "uint" || type == "uint32")
    {
      return this->As<std::uint32_t>();
    }
    if (type == "float" || type == "float32")
    {
      return this->As<float>();
    }
    if (type == "double" || type == "float64")
    {
      return this->As<double>();
    }
    throw std::runtime_error("unknown type " + type);
  }

private:
  template<class Number>
  Number As()
  {
    if (position_ + sizeof(Number) > bytes_.size())
    {
      throw std::runtime_error("the file ends too early");
    }
    Number number;
    std::memcpy(&number, bytes_.data() + position_, sizeof(Number));
    position_ += sizeof(Number);
    return number;
  }

  const std::string& bytes_;
  std::size_t position_;
};

struct PlyProperty
{
  std::string name;
  std::string type;
  std::string countType; // of a list; otherwise empty
};

struct PlyElement
{
  std::string name;
  Id count = 0;
  std::vector<PlyProperty> properties;
};

/// Reads the header and returns the position after it.
std::size_t ReadPlyHeader(const std::string& bytes, std::vector<PlyElement>& elements)
{
  const std::string end = "end_header\n";
  const std::size_t length = bytes.find(end);
  if (length == std::string::npos || bytes.find("format binary_little_endian") == std::string::npos)
  {
    throw std::runtime_error("not a binary little-endian PLY file");
  }
  std::istringstream lines(bytes.substr(0, length));
  for (std::string line; std::getline(lines, line);)
  {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "element")
    {
      PlyElement element;
      words >> element.name >> element.count;
      elements.push_back(element);
    }
    else if (keyword == "property")
    {
      PlyProperty property;
      words >> property.type;
      if (property.type == "list")
      {
        words >> property.countType >> property.type;
      }
      words >> property.name;
      elements.at(elements.size() - 1).properties.push_back(property);
    }
  }
  return length + end.size();
}

void ReadPlyItem(const PlyElement& element, ByteReader& reader, TriangleMesh& mesh)
{
  Vec3 point = Vec3::Zero();
  for (const PlyProperty& property : element.properties)
  {
    if (property.countType.empty())
    {
      const double value = reader.Next(property.type);
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
      {
        point[property.name[0] - 'x'] = value;
      }
      continue;
    }
    std::vector<Id> polygon(static_cast<std::size_t>(reader.Next(property.countType)));
    for (Id& corner : polygon)
    {
      corner = static_cast<Id>(reader.Next(property.type));
    }
    AddFan(mesh, polygon);
  }
  if (element.name == "vertex")
  {
    mesh.points.push_back(point);
  }
}

TriangleMesh ReadPly(const std::string& bytes)
{
  TriangleMesh mesh;
  std::vector<PlyElement> elements;
  ByteReader reader(bytes, ReadPlyHeader(bytes, elements));
  for (const PlyElement& element : elements)
  {
    for (Id item = 0; item < element.count; ++item)
    {
      ReadPlyItem(element, reader, mesh);
    }
  }
  return mesh;
}

TriangleMesh ReadBinaryStl(const std::string& bytes, Id count)
{
  constexpr std::size_t header = 84, record = 50, normal = 12;
  TriangleMesh mesh;
  for (Id triangle = 0; triangle < count; ++triangle)
  {
    ByteReader reader(bytes, header + triangle * record + normal);
    for (int corner = 0; corner < 3; ++corner)
    {
      const double x = reader.Next("float"), y = reader.Next("float"), z = reader.Next("float");
      mesh.points.emplace_back(x, y, z);
    }
  }
  AddSoupTriangles(mesh);
  return mesh;
}

TriangleMesh ReadStl(const std::string& bytes)
{
  if (bytes.size() >= 84)
  {
    const Id count = static_cast<Id>(ByteReader(bytes, 80).Next("uint"));
    if (bytes.size() == std::size_t(84 + 50 * count))
    {
      return ReadBinaryStl(bytes, count);
    }
  }
  TriangleMesh mesh;
  std::istringstream words(bytes);
  for (std::string word; words >> word;)
  {
    if (word == "vertex")
    {
      Vec3 point;
      words >> point[0] >> point[1] >> point[2];
      mesh.points.push_back(point);
    }
  }
  AddSoupTriangles(mesh);
  return mesh;
}

TriangleMesh ReadOff(const std::string& bytes)
{
  std::istringstream lines(bytes);
  std::ostringstream numbers;
  for (std::string line; std::getline(lines, line);)
  {
    numbers << line.substr(0, line.find('#')) << '\n';
  }
  std::istringstream words(numbers.str());
  std::string keyword;
  Id points = 0, faces = 0, edges = 0;
  if (!(words >> keyword >> points >> faces >> edges) || keyword != "OFF")
  {
    throw std::runtime_error("not an OFF file");
  }
  TriangleMesh mesh;
  mesh.points.resize(points);
  for (Vec3& point : mesh.points)
  {
    words >> point[0] >> point[1] >> point[2];
  }
  for (Id face = 0; face < faces; ++face)
  {
    std::size_t count = 0;
    words >> count;
    std::vector<Id> polygon(count);
    for (Id& corner : polygon)
    {
      words >> corner;
    }
    std::getline(words, keyword); // an optional color
    AddFan(mesh, polygon);
  }
  if (!words && !words.eof())
  {
    throw std::runtime_error("a number cannot be read");
  }
  return mesh;
}

TriangleMesh ReadObj(const std::string& bytes)
{
  TriangleMesh mesh;
  std::istringstream lines(bytes);
  for (std::string line; std::getline(lines, line);)
  {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v")
    {
      Vec3 point;
      words >> point[0] >> point[1] >> point[2];
      mesh.points.push_back(point);
    }
    else if (word == "f")
    {
      std::vector<Id> polygon;
      while (words >> word)
      {
        const Id number = std::stoll(word); // stops at the slash of v/vt/vn
        polygon.push_back(number > 0 ? number - 1 : static_cast<Id>(mesh.points.size()) + number);
      }
      AddFan(mesh, polygon);
    }
  }
  return mesh;
}

} // namespace

TriangleMesh ReadMesh(const std::string& path)
{
  static const std::map<std::string, TriangleMesh (*)(const std::string&)> readers = {
    { ".ply", ReadPly }, { ".stl", ReadStl }, { ".off", ReadOff }, { ".obj", ReadObj }
  };
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& letter : extension)
  {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  const auto reader = readers.find(extension);
  if (reader == readers.end())
  {
    Fail(path, "unknown kind of file");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    Fail(path, "cannot be opened");
  }
  const std::string bytes{ std::istreambuf_iterator<char>(file), {} };
  try
  {
    return reader->second(bytes);
  }
  catch (const std::exception& error)
  {
    Fail(path, error.what());
  }
}

std::string RealMesh(const std::string& name)
{
  namespace fs = std::filesystem;
  const char* folder = std::getenv("GRIDFEM_DATA_DIR");
  const fs::path beside = fs::path(GRIDFEM_SOURCE_DIR) / ".." / "shared" / "data";
  const fs::path path = (folder ? fs::path(folder) : beside) / name;
  return fs::exists(path) ? path.string() : std::string();
}

} // namespace gridfem::testing
