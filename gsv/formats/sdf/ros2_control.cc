#include "gsv/formats/sdf/ros2_control.h"

#include <algorithm>
#include <string>

#include "gsv/formats/sdf/sdf_xml.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

std::string AttributeOf(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

std::vector<std::string> NamesOf(const XMLElement& joint, const char* interface) {
  std::vector<std::string> names;
  for (auto* each = joint.FirstChildElement(interface); each != nullptr;
       each = each->NextSiblingElement(interface)) {
    names.push_back(AttributeOf(*each, "name"));
  }
  return names;
}

std::string HardwareOf(const XMLElement& system) {
  const auto* hardware = system.FirstChildElement("hardware");
  const auto* plugin = hardware == nullptr ? nullptr : hardware->FirstChildElement("plugin");
  return plugin == nullptr || plugin->GetText() == nullptr ? "" : plugin->GetText();
}

}  // namespace

std::vector<model::ControlSystem> ReadControlSystems(const XMLElement& element,
                                                     const std::filesystem::path& file,
                                                     const model::Model& model,
                                                     base::Problems& problems) {
  std::vector<model::ControlSystem> systems;
  for (auto* each = element.FirstChildElement("ros2_control"); each != nullptr;
       each = each->NextSiblingElement("ros2_control")) {
    model::ControlSystem system{
        AttributeOf(*each, "name"), AttributeOf(*each, "type"), HardwareOf(*each), {}};
    for (auto* joint = each->FirstChildElement("joint"); joint != nullptr;
         joint = joint->NextSiblingElement("joint")) {
      const std::string name = AttributeOf(*joint, "name");
      const bool is_there =
          std::any_of(model.joints.begin(), model.joints.end(),
                      [&](const model::Joint& known) { return known.name == name; });
      if (!is_there) {
        problems.push_back({base::Problem::Severity::kWarning,
                            "<ros2_control> names the joint \"" + name +
                                "\", which the model does not have; it is ignored",
                            PlaceOf(file, *joint)});
        continue;
      }
      system.joints.push_back(
          {name, NamesOf(*joint, "command_interface"), NamesOf(*joint, "state_interface")});
    }
    systems.push_back(std::move(system));
  }
  return systems;
}

std::shared_ptr<const model::Model> WithControlSystems(const XMLElement& element,
                                                       const std::filesystem::path& file,
                                                       std::shared_ptr<const model::Model> model,
                                                       base::Problems& problems) {
  auto systems = ReadControlSystems(element, file, *model, problems);
  if (systems.empty()) return model;
  auto completed = std::make_shared<model::Model>(*model);
  completed->control_systems = std::move(systems);
  return completed;
}

}  // namespace gsv::formats
