#include "gsv/formats/sdf/shape_model.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <vector>

namespace gsv::formats {
namespace {

constexpr std::string_view kScheme = "shape:";
constexpr std::size_t kMaxShapeName = 256;

using Options = std::map<std::string, std::string, std::less<>>;

// The geometry as SDFormat text, and the principal moments of inertia per kilogram (m²).
struct Solid {
  std::string geometry;
  double xx = 0, yy = 0, zz = 0;
};

std::optional<double> WholeNumber(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string NumberText(double number) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, number);
  return {text, end};
}

class ShapeReader {
 public:
  explicit ShapeReader(const std::string& name) : name_(name) {}

  base::Result<std::string> Read() {
    if (name_.size() > kMaxShapeName) return Refuse("the name is longer than 256 characters");
    const std::string rest = name_.substr(kScheme.size());
    const std::size_t question = std::min(rest.find('?'), rest.size());
    const std::string kind = rest.substr(0, question);
    if (auto ok = TakeOptions(rest.substr(std::min(question + 1, rest.size()))); !ok) {
      return Fail(ok.error());
    }
    const auto solid = SolidOf(kind);
    if (!solid) return Fail(solid.error());
    const auto mass = Number("mass", 1, 1e-6, 1e6);
    if (!mass) return Fail(mass.error());
    const auto is_static = Flag("static", kind == "wall");
    if (!is_static) return Fail(is_static.error());
    const auto colour = ColourText();
    if (!colour) return Fail(colour.error());
    if (!options_.empty()) return Refuse("there is no option \"" + options_.begin()->first + "\"");
    return Document(kind, *solid, *mass, *is_static, *colour);
  }

 private:
  base::Failure<base::Error> Refuse(const std::string& reason) const {
    return base::Fail(base::ErrorCode::kBadModel, reason, name_.substr(0, kMaxShapeName));
  }

  base::Status TakeOptions(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('&'), text.size());
      const std::string_view option = text.substr(0, end);
      const std::size_t sign = option.find('=');
      if (sign == std::string_view::npos) return Refuse("options have the form NAME=VALUE");
      options_[std::string(option.substr(0, sign))] = option.substr(sign + 1);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    return {};
  }

  std::optional<std::string> Take(const std::string& option) {
    const auto found = options_.find(option);
    if (found == options_.end()) return std::nullopt;
    std::string value = std::move(found->second);
    options_.erase(found);
    return value;
  }

  base::Result<double> Bounded(const std::string& option, std::string_view text, double low,
                               double high) const {
    const auto number = WholeNumber(text);
    if (number && *number >= low && *number <= high) return *number;
    return Refuse(option + " must be " + NumberText(low) + " to " + NumberText(high) + ", not \"" +
                  std::string(text) + "\"");
  }

  base::Result<double> Number(const std::string& option, std::optional<double> preset, double low,
                              double high) {
    const auto text = Take(option);
    if (text) return Bounded(option, *text, low, high);
    if (preset) return *preset;
    return Refuse("the option " + option + " is missing");
  }

  base::Result<bool> Flag(const std::string& option, bool preset) {
    const auto text = Take(option);
    if (!text) return preset;
    if (*text == "true" || *text == "false") return *text == "true";
    return Refuse(option + " must be true or false, not \"" + *text + "\"");
  }

  base::Result<std::vector<double>> Size() {
    const auto text = Take("size");
    if (!text) return Refuse("the option size is missing");
    std::vector<double> size;
    for (std::string_view rest = *text; size.size() < 4;) {
      const std::size_t end = std::min(rest.find(','), rest.size());
      const auto length = Bounded("size", rest.substr(0, end), 1e-3, 1000);
      if (!length) return Fail(length.error());
      size.push_back(*length);
      if (end == rest.size()) break;
      rest.remove_prefix(end + 1);
    }
    if (size.size() != 3) return Refuse("size needs 3 numbers: X,Y,Z");
    return size;
  }

  base::Result<Solid> SolidOf(const std::string& kind) {
    if (kind == "box" || kind == "wall") return BoxOfSize();
    if (kind != "cylinder" && kind != "sphere") {
      return Refuse("there is no shape \"" + kind + "\"; use box, wall, cylinder or sphere");
    }
    const auto radius = Number("radius", std::nullopt, 1e-3, 1000);
    if (!radius) return Fail(radius.error());
    const double r2 = *radius * *radius;
    const std::string radius_text = "<radius>" + NumberText(*radius) + "</radius>";
    if (kind == "sphere") {
      return Solid{"<sphere>" + radius_text + "</sphere>", 0.4 * r2, 0.4 * r2, 0.4 * r2};
    }
    const auto length = Number("length", std::nullopt, 1e-3, 1000);
    if (!length) return Fail(length.error());
    const double across = (3 * r2 + *length * *length) / 12;
    return Solid{
        "<cylinder>" + radius_text + "<length>" + NumberText(*length) + "</length></cylinder>",
        across, across, 0.5 * r2};
  }

  base::Result<Solid> BoxOfSize() {
    const auto size = Size();
    if (!size) return Fail(size.error());
    const double x = (*size)[0], y = (*size)[1], z = (*size)[2];
    return Solid{
        "<box><size>" + NumberText(x) + " " + NumberText(y) + " " + NumberText(z) + "</size></box>",
        (y * y + z * z) / 12, (x * x + z * z) / 12, (x * x + y * y) / 12};
  }

  // Returns the colour as "R G B A", with numbers from 0 to 1.
  base::Result<std::string> ColourText() {
    const std::string digits = Take("colour").value_or("b4b4b4");
    unsigned value = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (digits.size() != 6 || error != std::errc() || end != digits.data() + digits.size()) {
      return Refuse("colour must be six hexadecimal digits, not \"" + digits + "\"");
    }
    std::string text;
    for (const int shift : {16, 8, 0}) text += NumberText(((value >> shift) & 255) / 255.0) + " ";
    return text + "1";
  }

  static std::string Document(const std::string& kind, const Solid& solid, double mass,
                              bool is_static, const std::string& colour) {
    const std::string geometry = "<geometry>" + solid.geometry + "</geometry>";
    return "<sdf version='1.9'><model name='" + kind + "'><static>" +
           (is_static ? "true" : "false") + "</static><link name='link'><inertial><mass>" +
           NumberText(mass) + "</mass><inertia><ixx>" + NumberText(solid.xx * mass) +
           "</ixx><iyy>" + NumberText(solid.yy * mass) + "</iyy><izz>" +
           NumberText(solid.zz * mass) +
           "</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>"
           "<collision name='collision'>" +
           geometry + "</collision><visual name='visual'>" + geometry + "<material><ambient>" +
           colour + "</ambient><diffuse>" + colour +
           "</diffuse><specular>0.1 0.1 0.1 1</specular></material></visual></link></model></sdf>";
  }

  const std::string name_;
  Options options_;
};

}  // namespace

bool IsShapeName(std::string_view name) { return name.substr(0, kScheme.size()) == kScheme; }

base::Result<std::string> SdfOfShape(const std::string& name) { return ShapeReader(name).Read(); }

}  // namespace gsv::formats
