// Declares a behaviour, so that the same binary runs as a program and as a plug-in of gsv. In the
// source file of the behaviour:
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

// The version of the interface. Increase it with every change of Robot, Behaviour or
// BehaviourModule.
inline constexpr int kBehaviourInterface = 6;
// Name of the function by which a plug-in returns its BehaviourModule.
inline constexpr const char* kBehaviourModuleSymbol = "gsv_behaviour_module";

// The description of a behaviour, and how to make it.
struct BehaviourModule {
  int interface_version = kBehaviourInterface;
  std::string name;         // the name of the offer, such as "wander"
  std::string description;  // one line for --help
  // Adds the behaviour's own options, if it has any, to the parser, and returns the factory. The
  // factory is called after the command line has been parsed, so it can use the values of these
  // options.
  std::function<BehaviourFactory(CLI::App&)> configure;
  // Whether the behaviour uses only the robot's clock, so that a simulation may wait for it.
  bool time_managed = true;
};

}  // namespace gsv

extern "C" const gsv::BehaviourModule* gsv_behaviour_module();

// Declares a behaviour. `make` is an expression of the type gsv::BehaviourModule. The expression is
// evaluated once.
#define GSV_BEHAVIOUR_MODULE(make)                                \
  extern "C" const gsv::BehaviourModule* gsv_behaviour_module() { \
    static const gsv::BehaviourModule module = make;              \
    return &module;                                               \
  }

// Declares a behaviour that is a class with a default constructor.
#define GSV_BEHAVIOUR(name, description, Class)    \
  GSV_BEHAVIOUR_MODULE((gsv::BehaviourModule{      \
      gsv::kBehaviourInterface, name, description, \
      [](CLI::App&) { return gsv::BehaviourFactory([] { return std::make_unique<Class>(); }); }}))
