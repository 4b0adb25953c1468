#include "gsv/ros2/services/parameter_services.h"

#include "gsv/messages/rcl_interfaces.h"

namespace gsv::ros2 {
namespace {

namespace rcl = messages::rcl_interfaces;
using Lane = ServiceHost::Lane;

constexpr const char* kUseSimTime = "use_sim_time";
constexpr std::uint8_t kNotSet = 0, kBool = 1;  // rcl_interfaces/msg/ParameterType

rcl::ParameterValue ValueOf(const std::string& name) {
  rcl::ParameterValue value;
  value.type = name == kUseSimTime ? kBool : kNotSet;
  value.bool_value = name == kUseSimTime;
  return value;
}

rcl::ParameterDescriptor DescriptorOf(const std::string& name) {
  rcl::ParameterDescriptor descriptor;
  descriptor.name = name;
  if (name != kUseSimTime) return descriptor;
  descriptor.type = kBool;
  descriptor.description = "gsv publishes /clock and uses the simulated time";
  descriptor.read_only = true;
  return descriptor;
}

rcl::SetParametersResult ResultOfSetting(const rcl::Parameter& parameter) {
  if (parameter.name != kUseSimTime) return {false, "gsv has only the parameter use_sim_time"};
  if (parameter.value == ValueOf(kUseSimTime)) return {true, ""};
  return {false, "use_sim_time is always true"};
}

// A prefix "a.b" selects the parameter "a.b" and the parameters below it.
bool IsListed(const rcl::ListParametersRequest& request) {
  for (const std::string& prefix : request.prefixes) {
    if (prefix == kUseSimTime) return true;
  }
  return request.prefixes.empty();
}

}  // namespace

void OfferParameterServices(ServiceHost& host, const std::string& node) {
  host.Offer<rcl::GetParametersRequest>(node + "/get_parameters",
                                        "rcl_interfaces/srv/GetParameters", Lane::kQuick,
                                        [](const rcl::GetParametersRequest& request) {
                                          rcl::GetParametersResponse response;
                                          for (const std::string& name : request.names)
                                            response.values.push_back(ValueOf(name));
                                          return response;
                                        });
  host.Offer<rcl::GetParameterTypesRequest>(node + "/get_parameter_types",
                                            "rcl_interfaces/srv/GetParameterTypes", Lane::kQuick,
                                            [](const rcl::GetParameterTypesRequest& request) {
                                              rcl::GetParameterTypesResponse response;
                                              for (const std::string& name : request.names)
                                                response.types.push_back(ValueOf(name).type);
                                              return response;
                                            });
  host.Offer<rcl::DescribeParametersRequest>(node + "/describe_parameters",
                                             "rcl_interfaces/srv/DescribeParameters", Lane::kQuick,
                                             [](const rcl::DescribeParametersRequest& request) {
                                               rcl::DescribeParametersResponse response;
                                               for (const std::string& name : request.names) {
                                                 response.descriptors.push_back(DescriptorOf(name));
                                               }
                                               return response;
                                             });
  host.Offer<rcl::ListParametersRequest>(node + "/list_parameters",
                                         "rcl_interfaces/srv/ListParameters", Lane::kQuick,
                                         [](const rcl::ListParametersRequest& request) {
                                           rcl::ListParametersResponse response;
                                           if (IsListed(request))
                                             response.result.names.emplace_back(kUseSimTime);
                                           return response;
                                         });
  host.Offer<rcl::SetParametersRequest>(node + "/set_parameters",
                                        "rcl_interfaces/srv/SetParameters", Lane::kQuick,
                                        [](const rcl::SetParametersRequest& request) {
                                          rcl::SetParametersResponse response;
                                          for (const rcl::Parameter& each : request.parameters) {
                                            response.results.push_back(ResultOfSetting(each));
                                          }
                                          return response;
                                        });
  host.Offer<rcl::SetParametersAtomicallyRequest>(
      node + "/set_parameters_atomically", "rcl_interfaces/srv/SetParametersAtomically",
      Lane::kQuick, [](const rcl::SetParametersAtomicallyRequest& request) {
        rcl::SetParametersAtomicallyResponse response;
        response.result.successful = true;
        for (const rcl::Parameter& each : request.parameters) {
          const auto result = ResultOfSetting(each);
          if (!result.successful) response.result = result;
        }
        return response;
      });
}

}  // namespace gsv::ros2
