"""The operations of GSV's servants, from the IDL itself."""

import importlib.util
import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
IDL = ROOT / "idl"

OF_ALL = {"_is_a": (("in", "id", "string"),), "_non_existent": ()}  # operations that the ORB implements for every object


@dataclass(frozen=True)
class Operation:
    interface: str  # the interface of the operation: "sba::Sonar"
    name: str       # the name of the operation in messages
    parameters: tuple
    result: object

    def __str__(self):
        return f"{self.interface}::{self.name}"


class Contracts:
    def __init__(self):
        self.by_id = {}
        for file in [*sorted(IDL.glob("*.idl")), ROOT / "gsv/broker/trading.idl"]:
            told = subprocess.run(["omniidl", f"-I{IDL}", f"-p{HERE}", "-bsignatures", str(file)],
                                  capture_output=True, text=True, check=True)
            self.by_id.update(json.loads(told.stdout))
        self.ids = {told["name"]: identity for identity, told in self.by_id.items()}
        self.interfaces = sorted(self.ids)

    def ancestors(self, interface):
        """Returns the interface and its bases; the interface itself is first."""
        found = [interface]
        for base in self.by_id[self.ids[interface]]["bases"]:
            found += [each for each in self.ancestors(self.by_id[base]["name"]) if each not in found]
        return found

    def operations(self, interface):
        """Returns the operations of an interface, including inherited ones."""
        return [Operation(interface, told["name"], tuple(tuple(each) for each in told["parameters"]),
                          freeze(told["result"]))
                for each in self.ancestors(interface) for told in self.by_id[self.ids[each]]["operations"]
                ] + [Operation(interface, name, parameters, "boolean") for name, parameters in OF_ALL.items()]

    def operation(self, interface, name):
        return next(each for each in self.operations(interface) if each.name == name)


def freeze(kind):
    return kind if isinstance(kind, str) else tuple(kind)


def standard_trading_operations():
    """Returns the names of operations by interface, as tools/check_conformance.py reads them from the standard."""
    where = ROOT / "tools/check_conformance.py"
    spec = importlib.util.spec_from_file_location("check_conformance", where)
    standard = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(standard)
    modules = {"ServiceTypeRepository": "CosTradingRepos", "DynamicPropEval": "CosTradingDynamic"}
    found = {name: list(operations) for name, operations in standard.OPERATIONS.items()}
    for name, attributes in standard.ATTRIBUTES.items():
        found[name] = found.get(name, []) + [f"_get_{each}" for each in attributes.split()]
    return {f"{modules.get(name, 'CosTrading')}::{name}": names for name, names in found.items()}
