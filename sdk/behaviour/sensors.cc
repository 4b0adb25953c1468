#include "sdk/behaviour/sensors.h"

#include "gsv/base/base64.h"

namespace gsv {
namespace {

constexpr double kSonarMaximum = 5;  // in m; used if the parameters of the sonar do not set it

}  // namespace

double Sensor::Number(const std::string& parameter, double otherwise) const {
  const auto found = traits().parameters.find(parameter);
  if (found == traits().parameters.end()) return otherwise;
  const double* const value = std::get_if<double>(&found->second);
  return value != nullptr ? *value : otherwise;
}

Sonar::Sonar(std::unique_ptr<SensorPort> port)
    : Sensor(std::move(port)), max_range_(Number("max", kSonarMaximum)) {}

double Sonar::Range() {
  const auto sonar = In<readings::Sonar>(Measure());
  return sonar ? sonar->range : max_range_;
}

Lidar::Scan Lidar::Read() {
  auto scan = MeasureAs<readings::Lidar>();
  if (Number(readings::Lidar::kIntensityParameter, 0) > 0) scan = scan.WithIntensities();
  return {{scan.ranges.begin(), scan.ranges.end()},
          {scan.intensities.begin(), scan.intensities.end()}};
}

const std::vector<double>& Lidar::Ranges() {
  if (!(Number(readings::Lidar::kIntensityParameter, 0) > 0)) return Measure().values;
  ranges_ = Read().ranges;
  return ranges_;
}

std::vector<Radio::Message> Radio::Receive() {
  std::vector<Message> messages;
  for (const readings::HeardMessage& heard : MeasureAs<readings::Radio>().messages) {
    auto content = base::FromBase64(heard.content_base64);
    if (heard.number <= received_ || !content) continue;
    missed_ += heard.number - received_ - 1;
    received_ = heard.number;
    messages.push_back(
        {heard.sender, *std::move(content), base::FromSeconds(heard.sent), heard.strength});
  }
  return messages;
}

}  // namespace gsv
