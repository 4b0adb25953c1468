#include "gsv/formats/sdf/sdf_medium.h"

#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "gsv/base/sorting.h"
#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/formats/sdf/value_text.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kMaxLayers = 1000;

// Whether the plugin's file name (without ".so") or class name ends with one of `parts`. The names
// are compared in lower case, without "-" and "_".
bool IsPlugin(const XMLElement& plugin, std::initializer_list<std::string_view> parts) {
  for (const char* attribute : {"filename", "name"}) {
    std::string plain;
    const char* text = plugin.Attribute(attribute);
    for (const char* c = text == nullptr ? "" : text; *c != '\0'; ++c) {
      if (*c != '-' && *c != '_')
        plain += static_cast<char>(std::tolower(static_cast<unsigned char>(*c)));
    }
    for (const std::string_view part : parts) {
      if (plain.ends_with(part) || plain.ends_with(std::string(part) + ".so")) return true;
    }
  }
  return false;
}

class MediumReader {
 public:
  explicit MediumReader(const ReadingContext& context) : context_(context) {}

  // Returns the number of a child, which must be at least `least`. Returns `otherwise` if there is
  // no such child.
  double Number(const XMLElement& parent, const char* name, double otherwise, double least) const {
    const XMLElement* element = parent.FirstChildElement(name);
    return element == nullptr ? otherwise : NumberOf(*element, otherwise, least);
  }

  double NumberOf(const XMLElement& element, double otherwise, double least) const {
    const char* text = element.GetText();
    const auto number = LeadingNumberOf(text == nullptr ? "" : text);
    if (number.is_number && std::isfinite(number.value) && number.value >= least) {
      return number.value;
    }
    const std::string bound = std::isfinite(least) ? fmt::format(" of at least {:g}", least) : "";
    Warn(element, fmt::format("must be a number{}, not {}; {:g} is used", bound,
                              Quoted(text == nullptr ? "" : text), otherwise));
    return otherwise;
  }

  void ReadWind(const XMLElement& wind, model::WorldDescription& world) const {
    const XMLElement* element = wind.FirstChildElement("linear_velocity");
    if (element == nullptr) return;
    const char* text = element->GetText();
    const std::vector<std::string> words = WordsOf(text == nullptr ? "" : text);
    geometry::Vector3 velocity;
    const auto component = [&](std::size_t i) { return LeadingNumberOf(words[i]).value; };
    if (words.size() == 3) velocity = {component(0), component(1), component(2)};
    if (words.size() != 3 || !geometry::IsFinite(velocity)) {
      Warn(*element, "must be three numbers; there is no wind");
      return;
    }
    if (velocity == geometry::Vector3{}) return;
    world.wind = model::Wind{velocity, 1};
  }

  void ReadWindEffects(const XMLElement& plugin, model::Wind& wind) const {
    const XMLElement* factor = plugin.FirstChildElement("force_approximation_scaling_factor");
    if (factor != nullptr && factor->FirstChildElement() == nullptr) {
      wind.drag = NumberOf(*factor, 1, 0);
    } else if (factor != nullptr) {
      Warn(*factor, "cannot vary with the position; the factor 1 is used");
    }
    for (const char* varying : {"horizontal", "vertical"}) {
      const XMLElement* element = plugin.FirstChildElement(varying);
      if (element != nullptr && element->FirstChildElement() != nullptr) {
        Warn(*element, "is not supported: the wind is constant");
      }
    }
  }

  model::Fluid ReadFluid(const XMLElement& plugin) const {
    model::Fluid fluid;
    fluid.density = Number(plugin, "uniform_fluid_density", fluid.density, 0);
    if (const auto* graded = plugin.FirstChildElement("graded_buoyancy")) {
      fluid.density = Number(*graded, "default_density", fluid.density, 0);
      for (auto* change = graded->FirstChildElement("density_change");
           change != nullptr && fluid.layers.size() < kMaxLayers;
           change = change->NextSiblingElement("density_change")) {
        fluid.layers.push_back({Number(*change, "above_depth", 0, -INFINITY),
                                Number(*change, "density", fluid.density, 0)});
      }
      base::Sort(fluid.layers, [](const auto& a, const auto& b) { return a.above < b.above; });
    }
    for (auto* each = plugin.FirstChildElement("enable"); each != nullptr;
         each = each->NextSiblingElement("enable")) {
      if (each->GetText() != nullptr) fluid.lifted.emplace_back(each->GetText());
    }
    return fluid;
  }

 private:
  void Warn(const XMLElement& element, const std::string& what) const {
    context_.Warn("<" + std::string(element.Name()) + "> " + what,
                  PlaceOf(context_.source, element));
  }

  const ReadingContext& context_;
};

}  // namespace

void ReadMedium(const XMLElement& world, const ReadingContext& context,
                model::WorldDescription& description) {
  const MediumReader reader(context);
  if (const auto* wind = world.FirstChildElement("wind")) reader.ReadWind(*wind, description);
  for (auto* plugin = world.FirstChildElement("plugin"); plugin != nullptr;
       plugin = plugin->NextSiblingElement("plugin")) {
    if (IsPlugin(*plugin, {"windeffects", "windeffectssystem", "windplugin"})) {
      if (description.wind) reader.ReadWindEffects(*plugin, *description.wind);
    } else if (IsPlugin(*plugin, {"systems::buoyancy", "buoyancysystem"})) {
      description.fluid = reader.ReadFluid(*plugin);
    }
  }
}

}  // namespace gsv::formats
