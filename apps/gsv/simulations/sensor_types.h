// The sensor types of this program: the built-in ones, the cameras, and those of plug-ins.
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
  std::vector<std::filesystem::path> plugins;  // besides those of GSV_SENSOR_PLUGIN_PATH
  // Changes the camera type before it is registered; may be empty.
  std::function<void(sensing::SensorType&)> adapt_camera;
};

// Without a renderer there are cameras that can be made, but not read. Fails when a plug-in cannot
// be loaded.
base::Result<std::shared_ptr<const sensing::SensorRegistry>> MakeSensorTypes(
    const SensorTypeOptions& options, base::Result<std::shared_ptr<rendering::Renderer>> renderer);

// For formats::ReadOptions: what these types say of a sensor.
formats::SensorCheck CheckBy(std::shared_ptr<const sensing::SensorRegistry> types);

// --sensor-plugin, of every command that has to do with sensors. `plugins` outlives the parsing.
CLI::Option* AddSensorPluginOption(CLI::App& command, std::vector<std::string>& plugins);

}  // namespace gsv::app
