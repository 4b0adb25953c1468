// How a behaviour is made known, so that it runs as a program of its own and inside gsv, compiled
// once. In the file that holds the behaviour:
//
//   GSV_BEHAVIOUR("wander", "Wanders about without hitting anything.", Wander)
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sdk/behaviour/behaviour.h"

namespace CLI {
class App;
}

namespace gsv {

// Grows with every change of Robot, Behaviour or BehaviourModule.
inline constexpr int kBehaviourInterface = 5;
inline constexpr const char* kBehaviourModuleSymbol = "gsv_behaviour_module";

struct BehaviourModule {
  int interface_version = kBehaviourInterface;
  std::string name;         // the offer's: "wander"
  std::string description;  // one line for --help
  // Adds the behaviour's own options, if it has any, and gives what makes instances with the values
  // that are then read into them.
  std::function<BehaviourFactory(CLI::App&)> configure;
  // It tells the time by the robot's clock only, so that a simulation may wait for it.
  bool time_managed = true;
};

}  // namespace gsv

extern "C" const gsv::BehaviourModule* gsv_behaviour_module();

// `make` is an expression that gives a gsv::BehaviourModule; it is evaluated once.
#define GSV_BEHAVIOUR_MODULE(make)                                \
  extern "C" const gsv::BehaviourModule* gsv_behaviour_module() { \
    static const gsv::BehaviourModule module = make;              \
    return &module;                                               \
  }

// The behaviour is a class with a default constructor.
#define GSV_BEHAVIOUR(name, description, Class)    \
  GSV_BEHAVIOUR_MODULE((gsv::BehaviourModule{      \
      gsv::kBehaviourInterface, name, description, \
      [](CLI::App&) { return gsv::BehaviourFactory([] { return std::make_unique<Class>(); }); }}))
