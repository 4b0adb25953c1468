#include "apps/gsv/simulations/sensor_types.h"

#include <cstdlib>
#include <utility>

#include <CLI/CLI.hpp>

#include "gsv/base/check.h"
#include "gsv/rendering/cameras/camera_sensor.h"
#include "gsv/rendering/cameras/ground_truth_sensors.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/services/sensor_plugins.h"
#include "gsv/simulation/robots/mounted_sensor.h"

namespace gsv::app {
namespace {

base::Status LoadSensorPlugins(const SensorTypeOptions& options, sensing::SensorRegistry& types) {
  const char* const folders = std::getenv("GSV_SENSOR_PLUGIN_PATH");
  auto files = services::FindSensorPlugins(folders == nullptr ? "" : folders);
  files.insert(files.end(), options.plugins.begin(), options.plugins.end());
  for (const std::filesystem::path& file : files) {
    if (auto ok = services::LoadSensorPlugin(file, types); !ok) return ok;
  }
  return {};
}

}  // namespace

base::Result<std::shared_ptr<const sensing::SensorRegistry>> MakeSensorTypes(
    const SensorTypeOptions& options, base::Result<std::shared_ptr<rendering::Renderer>> renderer) {
  auto types = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*types);
  const auto surveys_added = rendering::AddGroundTruthSensors(*types, renderer);
  GSV_CHECK(surveys_added.has_value());
  sensing::SensorRegistry cameras;
  const auto cameras_added = rendering::AddCameraSensor(cameras, std::move(renderer));
  GSV_CHECK(cameras_added.has_value());
  for (const std::string& name : cameras.names()) {
    sensing::SensorType camera = *cameras.Find(name);
    if (name == "camera" && options.adapt_camera) options.adapt_camera(camera);
    const auto added = types->Add(std::move(camera));
    GSV_CHECK(added.has_value());
  }
  if (auto ok = LoadSensorPlugins(options, *types); !ok) return base::Fail(ok.error());
  return types;
}

formats::SensorCheck CheckBy(std::shared_ptr<const sensing::SensorRegistry> types) {
  return [types = std::move(types)](const model::SensorDescription& sensor) -> base::Status {
    const auto design =
        simulation::MakeSensorDesign(sensor, *types, sensor.type + " " + sensor.name);
    return design ? base::Status() : base::Fail(design.error());
  };
}

CLI::Option* AddSensorPluginOption(CLI::App& command, std::vector<std::string>& plugins) {
  return command
      .add_option("--sensor-plugin", plugins,
                  "library with sensor types, gsv-sensor-NAME.so\n"
                  "Libraries in the folders of GSV_SENSOR_PLUGIN_PATH are always loaded.")
      ->type_name("FILE");
}

}  // namespace gsv::app
