// The sensor types of this program: built-in types, cameras, and the types of plug-ins.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gsv/formats/sdf_reader.h"
#include "gsv/rendering/renderer.h"
#include "gsv/sensing/registry.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gsv::app {

struct SensorTypeOptions {
  // Plug-ins, in addition to the plug-ins in GSV_SENSOR_PLUGIN_PATH.
  std::vector<std::filesystem::path> plugins;
  // Changes the camera type before it is registered. May be empty.
  std::function<void(sensing::SensorType&)> adapt_camera;
};

// Registers the sensor types. If there is no renderer, cameras can be created but not read. Fails
// if a plug-in cannot be loaded.
base::Result<std::shared_ptr<const sensing::SensorRegistry>> MakeSensorTypes(
    const SensorTypeOptions& options, base::Result<std::shared_ptr<rendering::Renderer>> renderer);

// Returns the function that checks, while a file is read (formats::ReadOptions), whether a sensor
// of the file can be made with these types.
formats::SensorCheck CheckBy(std::shared_ptr<const sensing::SensorRegistry> types);

// Adds --sensor-plugin to a command that uses sensors. `plugins` must outlive the parsing.
CLI::Option* AddSensorPluginOption(CLI::App& command, std::vector<std::string>& plugins);

}  // namespace gsv::app
