"""Finds all servants of GSV, and provides arguments of a valid call for each operation."""

import itertools
import shutil

import contracts
from cdr import Reference
from giop import Refused, call, corbaloc
from robot_side import RobotSide

TRADER_KEYS = {"Lookup": b"TradingService", "Register": b"TradingRegister", "Admin": b"TradingAdmin",
               "Link": b"TradingLink", "Proxy": b"TradingProxy"}
REPOSITORY = "CosTradingRepos::ServiceTypeRepository"
# The type of sensor for each interface.
SENSORS = {"Sonar": "sonar", "Lidar": "lidar", "IntensityLidar": "lidar", "Camera": "camera", "PositioningSystem": "positioning", "Imu": "imu",
           "Odometer": "odometry", "SatelliteReceiver": "navsat", "Magnetometer": "magnetometer",
           "Altimeter": "altimeter", "Bumper": "contact", "Ranging": "ranging", "JointEncoders": "joint_encoders", "Battery": "battery",
           "LogicalCamera": "logical_camera", "Radio": "radio", "Microphone": "microphone",
           "DepthCamera": "depth_camera", "SegmentationCamera": "segmentation_camera",
           "BoundingBoxCamera": "boundingbox_camera",
           "ThermalCamera": "thermal_camera", "NormalsCamera": "normals_camera", "Lamp": "lamp", "Gripper": "gripper", "Speaker": "speaker"}
ACTS = {"sba::Lamp": {"values": [0.5, 1.0, 1.0, 1.0], "word": ""}, "sba::Gripper": {"values": [1.0], "word": ""},
        "sba::Speaker": {"values": [440.0, 0.1, 0.5], "word": "tone"}}
PLACE = {"x_m": 0.0, "y_m": 0.0, "z_m": 0.2, "roll_rad": 0.0, "pitch_rad": 0.0, "yaw_rad": 0.0}
WORLD = """<?xml version="1.0"?>
<sdf version="1.9"><world name="giop">
  <spherical_coordinates><latitude_deg>48</latitude_deg><longitude_deg>11</longitude_deg><elevation>500</elevation>
    <heading_deg>0</heading_deg></spherical_coordinates>
  <magnetic_field>6e-06 2.3e-05 -4.2e-05</magnetic_field>
  <model name="block"><static>true</static><pose>2 0 0.25 0 0 0</pose><link name="link">
    <collision name="c"><geometry><box><size>0.5 0.5 0.5</size></box></geometry></collision>
    <visual name="v"><geometry><box><size>0.5 0.5 0.5</size></box></geometry></visual></link></model>
</world></sdf>
"""
SCENARIO = "world: playground\nmode: lockstep\nduration: 0.02\nrobots:\n  - {model: pebble, x: 0, y: -1.5}\n"
COLUMN = ("sequence", ("struct", "IDL:giop/Point:1.0", "Point", [("x", "double"), ("name", ("string", 0))]), 0)
PROPERTIES = [
    {"name": "n", "value": ("long", 3)}, {"name": "text", "value": (("string", 0), "abc")},
    {"name": "names", "value": (("sequence", ("string", 0), 0), ["a", "b"])},
    {"name": "column", "value": (COLUMN, [(1.0, "a"), (2.0, "b")])},
    {"name": "choice", "value": (("union", "IDL:giop/U:1.0", "U", "long", [(1, "a", "double"), (2, "b", "any")]),
                                 (2, ("ushort", 7)))},
    {"name": "colour", "value": (("alias", "IDL:giop/A:1.0", "A",
                                  ("enum", "IDL:giop/E:1.0", "E", ["RED", "GREEN"])), 1)}]
POLICIES = [{"name": "search_card", "value": ("ulong", 10)}, {"name": "exact_type_match", "value": ("boolean", 1)}]
KEPT_ATTRIBUTES = ["def_search_card", "max_search_card", "def_match_card", "max_match_card", "def_return_card",
                   "max_return_card", "max_list", "supports_modifiable_properties", "supports_dynamic_properties",
                   "supports_proxy_offers", "def_hop_count", "max_hop_count", "def_follow_policy",
                   "max_follow_policy", "max_link_follow_policy"]
# Valid calls that a trader or a simulation refuses, with the exception that the refusal raises.
REFUSED = {
    "CosTrading::Register::resolve": "UnknownTraderName", "CosTrading::Admin::set_type_repos": "system exception",
    "sba::SensorFactory::open": "Refused", "sba::JointActuator::apply": "Refused",
    "sba::ScenarioRun::outcome": "NotRunning",
    # The sensor is on the base, which has no joint, so the sensor cannot be read. It is closed at
    # once.
    **{f"sba::ForceTorque::{name}": "OBJECT_NOT_EXIST"
       for name in ("wrench", "measure", "traits", "close", "_is_a", "_non_existent")}}


class World:
    """References to one object of each interface, and values for the arguments of calls."""

    def __init__(self, laboratory):
        self.laboratory = laboratory
        self.contracts = contracts.Contracts()
        self.numbers = itertools.count(1)
        self.robot_side = RobotSide()
        self.file = laboratory.folder / "giop.sdf"
        self.file.write_text(WORLD)
        broker = corbaloc(laboratory.reference)
        at_broker = {f"CosTrading::{name}": key for name, key in TRADER_KEYS.items()}
        at_broker[REPOSITORY] = b"TradingTypes"
        self.fixed = {name: Reference(self.contracts.ids[name], broker.host, broker.port, key)
                      for name, key in at_broker.items()}
        self.targets = dict(self.fixed)
        self.targets["sba::SimulationService"] = self.offered("gsv::SimulationService")["reference"]
        self.targets["sba::ScenarioService"] = self.offered("gsv::ScenarioService")["reference"]
        self.targets["sba::AgentBehaviourFactory"] = self.offered("gsv::AgentBehaviourFactory",
                                                                 "name == 'giop'")["reference"]
        self.attributes = {name: self.call("CosTrading::Admin", f"_get_{name}")[""] for name in KEPT_ATTRIBUTES}
        self.offers = set(self.call("CosTrading::Admin", "list_offers", how_many=1000)["ids"])
        self.targets["CosTradingDynamic::DynamicPropEval"] = self.evaluator()
        self.types = set(self.call(REPOSITORY, "list_types", which_types=("all", None))[""])
        self.simulations = set(laboratory.simulations())

    def call(self, interface, operation, **values):
        return call(self.targets[interface], self.contracts.operation(interface, operation), values)

    def offered(self, kind, constraint=""):
        found = self.call("CosTrading::Lookup", "query", type=kind, constr=constraint, pref="first", policies=[],
                          desired_props=("all", None), how_many=1)["offers"]
        if not found:
            raise RuntimeError(f"nobody offers {kind}")
        return found[0]

    def evaluator(self):
        """Returns the object that evaluates the dynamic properties of the server's offer."""
        for offer in self.offers:
            described = self.call("CosTrading::Register", "describe", id=offer)[""]
            for each in described["properties"]:
                if described["type"] == "gsv::SimulationService" and each["name"] == "load":
                    return each["value"][1]["eval_if"]
        raise RuntimeError("the server's offer has no dynamic property")

    # Restores what mutations may have removed or added

    def restore_trader(self):
        for name, value in self.attributes.items():
            parameter = self.contracts.operation("CosTrading::Admin", f"set_{name}").parameters[0][1]
            self.call("CosTrading::Admin", f"set_{name}", **{parameter: value})
        for interface, listing, withdrawal in (("CosTrading::Register", "list_offers", "withdraw"),
                                               ("CosTrading::Proxy", "list_proxies", "withdraw_proxy")):
            for offer in self.call("CosTrading::Admin", listing, how_many=1000)["ids"]:
                if offer not in self.offers:
                    self.call(interface, withdrawal, id=offer)
        for link in self.call("CosTrading::Link", "list_links")[""]:
            self.call("CosTrading::Link", "remove_link", name=link)
        types = self.call(REPOSITORY, "list_types", which_types=("all", None))[""]
        self.remove_types([name for name in types if name not in self.types])

    def remove_types(self, names):
        """Removes service types.

        The trader refuses to remove a type that still has sub types. So this function repeats its calls
        until all types are removed. Raises Refused if it cannot remove any of the types that are left.
        """
        while names:
            left, refused = [], None
            for name in names:
                try:
                    self.call(REPOSITORY, "remove_type", name=name)
                except Refused as refusal:  # it still has sub types
                    left.append(name)
                    refused = refusal
            if left == names:
                raise refused
            names = left

    def renew(self):
        """Makes a new simulation with a robot that has all sensors, and new offers, iterators, a run and a behaviour."""
        for name in self.laboratory.simulations():
            if name not in self.simulations:
                self.laboratory.destroy(name)
        for recording in self.laboratory.folder.glob("recording-*"):
            shutil.rmtree(recording)
        self.restore_trader()
        for name in ("giop::Thing", "giop::Spare"):
            self.call(REPOSITORY, "add_type", name=name, if_name="", props=[], super_types=[])
        self.ids = [self.call("CosTrading::Register", "export", **self.values_of("CosTrading::Register", "export"))[""]
                    for _ in range(3)]
        self.proxy = self.call("CosTrading::Proxy", "export_proxy",
                               **self.values_of("CosTrading::Proxy", "export_proxy"))[""]
        self.call("CosTrading::Link", "add_link", name="link_0", target=self.targets["CosTrading::Lookup"],
                  def_pass_on_follow_rule="local_only", limiting_follow_rule="local_only")
        found = self.call("CosTrading::Lookup", "query", type="giop::Thing", constr="", pref="", policies=[],
                          desired_props=("all", None), how_many=0)
        self.targets["CosTrading::OfferIterator"] = found["offer_itr"]
        self.targets["CosTrading::OfferIdIterator"] = self.call("CosTrading::Admin", "list_offers",
                                                                how_many=0)["id_itr"]
        self.simulation = f"giop-{next(self.numbers)}"
        self.targets["sba::Simulation"] = self.call(
            "sba::SimulationService", "create_simulation", specification=self.specification(self.simulation))[""]
        robot = {**self.robot_specification("porter", self.robot_side.reference, -2.0), "name": self.simulation}
        self.call("sba::Simulation", "add_robot", robot=robot)
        self.call("sba::Simulation", "start")
        self.targets["sba::JointedHardware"] = self.robot_side.hardware_of(self.simulation)
        for interface, operation in (("SensorFactory", "sensor_factory"), ("ActuatorProxy", "base"),
                                     ("SharedClock", "open_clock")):
            self.targets[f"sba::{interface}"] = self.call("sba::JointedHardware", operation)[""]
        self.joint = self.call("sba::JointedHardware", "list_joints")[""][0]["name"]
        self.targets["sba::JointActuator"] = self.call("sba::JointedHardware", "open_joint", name=self.joint)[""]
        for interface, kind in SENSORS.items():
            self.targets[f"sba::{interface}"] = self.call(
                "sba::SensorFactory", "create", type=kind,
                description=self.traits(f"my_{interface.lower()}", kind))[""]
        self.targets["sba::ForceTorque"] = self.call(
            "sba::SensorFactory", "create", type="force_torque",
            description=self.traits("my_forcetorque", "force_torque"))[""]
        self.call("sba::ForceTorque", "close")
        self.targets["sba::AgentBehaviour"] = self.call("sba::AgentBehaviourFactory", "create")[""]
        run = self.call("sba::ScenarioService", "run", **self.values_of("sba::ScenarioService", "run"))[""]
        if run.key:  # otherwise the server has reached its limit of runs
            self.targets["sba::ScenarioRun"] = run

    # Values

    def specification(self, name):
        return {"name": name, "world": str(self.file), "pacing": "REAL_TIME", "factor": 1.0, "step_ns": 0, "seed": 1,
                "duration_ns": 0, "keep": 1, "options": [{"name": "deadline_s", "value": "3600"}]}

    def robot_specification(self, model, behaviour=Reference(), x=0.0):
        return {"name": "", "model": model, "start": {**PLACE, "x_m": x}, "behaviour": behaviour,
                "behaviour_constraint": "", "options": [{"name": "on_ground", "value": "true"}]}

    def traits(self, name, kind):
        parameters = [{"name": "image.width", "value": "32"}, {"name": "image.height", "value": "24"}]
        if kind == "ranging":
            return {"name": name, "type": kind, "mounting": PLACE, "update_rate_hz": 0.0,
                    "parameters": [{"name": "anchor", "value": "block"}]}
        return {"name": name, "type": kind, "mounting": PLACE, "update_rate_hz": 0.0,
                "parameters": parameters if "camera" in kind else []}

    def values_of(self, interface, name):
        return self.values(self.contracts.operation(interface, name))

    def values(self, operation):
        """Returns the arguments of a call, by name."""
        own = ACTS.get(operation.interface) if operation.name == "act" else self.known_values().get(operation.name, {})
        if operation.interface == "CosTrading::Proxy" and operation.name.endswith("_proxy"):
            own = {**own, "id": self.proxy if hasattr(self, "proxy") else ""}
        return {name: own[name] if name in own else self.usual(kind, name)
                for direction, name, kind in operation.parameters if direction != "out"}

    def known_values(self):
        number = next(self.numbers)
        ids = getattr(self, "ids", [""])
        offer = {"type": "giop::Thing", "constr": "n >= 1 and exist text", "pref": "max n", "policies": POLICIES,
                 "desired_props": ("some", ["n", "text"]), "how_many": 1, "properties": PROPERTIES,
                 "reference": self.targets.get("sba::SimulationService", Reference()),
                 "target": self.targets["CosTrading::Lookup"], "id": ids[number % len(ids)]}
        specification = self.specification(f"giop-{number}")
        return {
            "query": offer, "withdraw": offer, "describe": offer, "withdraw_using_constraint": offer,
            "export": {**offer, "properties": [*PROPERTIES, {"name": "load", "value": self.dynamic()}]
                       if number % 2 and "CosTradingDynamic::DynamicPropEval" in self.targets else PROPERTIES},
            "modify": {**offer, "del_list": ["text"], "modify_list": [{"name": "n", "value": ("long", 4)}]},
            "resolve": {"name": ["nowhere"]},
            "export_proxy": {**offer, "recipe": "$*", "if_match_all": 1, "policies_to_pass_on": POLICIES},
            "add_link": {**offer, "name": f"link_{number}"}, "remove_link": {"name": "link_0"},
            "describe_link": {"name": "link_0"}, "modify_link": {"name": "link_0"},
            "set_request_id_stem": {"stem": b"giop"}, "set_type_repos": {"repository": self.targets[REPOSITORY]},
            "next_n": {"n": 1}, "evalDP": {"name": "load", "returned_type": "double", "extra_info": ("null", None)},
            "add_type": {"name": f"giop::Type{number}", "if_name": "", "super_types": ["giop::Thing"],
                         "props": [{"name": "p", "value_type": COLUMN, "mode": "PROP_NORMAL"}]},
            **{name: {"name": "giop::Thing"} for name in ("describe_type", "fully_describe_type", "mask_type",
                                                          "unmask_type")},
            "remove_type": {"name": "giop::Spare"}, "list_types": {"which_types": ("since", {"high": 0, "low": 0})},
            "create_simulation": {"specification": specification},
            "add_robot": {"robot": self.robot_specification("pebble")},
            "add_avatar": {"avatar": self.robot_specification("avatar", x=1.0)}, "remove_robot": {"name": "pebble"},
            "step": {"count": 1}, "run_until": {"instant": 10**15}, "set_factor": {"factor": 2.0},
            "command": {"name": "real_time_factor", "arguments": [{"name": "real_time_factor", "value": "2"}]}, "await_change": {"known": "PHASE_CREATED"},
            "start_recording": {"path": f"recording-{number}"},
            "run": {"scenario": SCENARIO, "options": [{"name": "timeout_s", "value": "10"}]},
            "init": {"agent_name": "giop", "robot": self.targets.get("sba::JointedHardware", Reference())},
            "open": {"name": "ahead"}, "open_joint": {"name": getattr(self, "joint", "")},
            "create_sonar": {"name": f"sonar_{number}", "min_m": 0.1, "max_m": 3.0},
            "create_camera": {"name": f"camera_{number}", "width": 32, "height": 24, "horizontal_fov_rad": 1.0},
            "create_positioning_system": {"name": f"positioning_{number}"},
            "create": {"type": "lidar", "description": self.traits(f"lidar_{number}", "lidar")},
            "exchange": {"cycle": 1, "instant": 0, "command": {
                "given": 1, "linear_m_s": 0.1, "lateral_m_s": 0.0, "angular_rad_s": 0.0}},
            "sleep_and_read": {"instant": 0, "sensors": ["ahead"], "command": {
                "given": 1, "linear_m_s": 0.1, "lateral_m_s": 0.0, "angular_rad_s": 0.0}},
            "sleep_until": {"instant": 0}, "send": {"receiver": "", "content": b"hello"}, "receive": {"after": 0},
            "play": {"sound": "tone", "frequency_hz": 440.0, "duration_s": 0.1, "volume": 0.5},
            "_is_a": {"id": "IDL:omg.org/CORBA/Object:1.0"}}

    def dynamic(self):
        code = ("struct", "IDL:omg.org/CosTradingDynamic/DynamicProp:1.0", "DynamicProp", [
            ("eval_if", ("objref", "IDL:omg.org/CosTradingDynamic/DynamicPropEval:1.0", "DynamicPropEval")),
            ("returned_type", "TypeCode"), ("extra_info", "any")])
        return (code, (self.targets["CosTradingDynamic::DynamicPropEval"], "double", ("null", None)))

    def usual(self, kind, name):
        if isinstance(kind, str):
            return {"string": "x", "float": 0.0, "double": 0.0, "any": ("long", 1), "TypeCode": "long",
                    "boolean": 1}.get(kind, 1)
        if kind[0] == "sequence":
            return b"" if kind[1] == "octet" else []
        if kind[0] == "struct":
            return {each: self.usual(member, each) for each, member in kind[2]}
        if kind[0] == "enum":
            return kind[2][0]
        return Reference() if kind[0] == "objref" else ("all", None)


def missing(world):
    """Returns a sentence for each interface without an object. Objects of derived interfaces count as well.

    Returns only one sentence if trading.idl lacks an operation of the standard.
    """
    for interface, names in contracts.standard_trading_operations().items():
        found = [each.name for each in world.contracts.operations(interface)]
        for name in names:
            if name not in found and f"_get_{name}" not in found:
                return [f"{interface}::{name} is not in gsv/broker/trading.idl"]
    reached = {base for interface in world.targets for base in world.contracts.ancestors(interface)}
    return [f"{interface}: tests/giop/seeds.py does not say how to reach a servant of it"
            for interface in world.contracts.interfaces if interface not in reached]


def prove(world):
    """Makes a valid call of each operation of each servant. Returns sentences about wrong responses."""
    broken = []
    last = ("give_up", "close", "destroy", "withdraw", "withdraw_proxy", "withdraw_using_constraint", "remove_link", "remove_type",
            "mask_type", "unmask_type", "stop", "reset")
    for interface in sorted(world.targets):
        if interface in ("sba::Simulation", "sba::AgentBehaviour"):
            continue  # called below, in a valid order
        operations = world.contracts.operations(interface)
        for operation in sorted(operations, key=lambda each: last.index(each.name) if each.name in last else -1):
            broken += prove_one(world, operation)
            if operation.name == "give_up":
                world.renew()  # the agent is dead, and its clock is closed
    world.renew()
    for operation in sorted(world.contracts.operations("sba::AgentBehaviour"), key=lambda each: each.name == "destroy"):
        broken += prove_one(world, operation)
    simulation = world.call("sba::SimulationService", "create_simulation", specification=world.specification(""))[""]
    world.targets["sba::Simulation"] = simulation
    order = ["add_robot", "add_avatar", "remove_robot", "start", "pause", "step", "run_until", "resume"]
    operations = world.contracts.operations("sba::Simulation")
    for operation in sorted(operations, key=lambda each: order.index(each.name) if each.name in order else
                            len(order) + (each.name in ("stop", "reset")) + 2 * (each.name == "destroy")):
        broken += prove_one(world, operation)
    world.renew()
    return broken


def prove_one(world, operation):
    try:
        call(world.targets[operation.interface], operation, world.values(operation))
    except Refused as refusal:
        expected = REFUSED.get(str(operation))
        return [] if expected is not None and expected in str(refusal) else [str(refusal)]
    except (OSError, EOFError, ValueError) as failure:
        return [f"{operation}: {failure}"]
    return []
