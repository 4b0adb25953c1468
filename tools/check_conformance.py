#!/usr/bin/env python3
"""Compares the table of operations, exceptions and tests in docs/broker.md with the standard's IDL.

Each operation and attribute needs a row with a test that calls it, directly or in its fixture. Each
exception that it raises needs a row with both names and a test that mentions the exception, unless
the row says "never". Each named test must exist.
"""
import pathlib
import re
import sys

# Attributes of the interfaces of the OMG's Trading Object Service (formal/00-06-27: CosTrading.idl,
# CosTradingRepos.idl and CosTradingDynamic.idl).
ATTRIBUTES = {
    "TraderComponents": "lookup_if register_if link_if proxy_if admin_if",
    "SupportAttributes": "supports_modifiable_properties supports_dynamic_properties"
                         " supports_proxy_offers type_repos",
    "ImportAttributes": "def_search_card max_search_card def_match_card max_match_card"
                        " def_return_card max_return_card max_list def_hop_count max_hop_count"
                        " def_follow_policy max_follow_policy",
    "LinkAttributes": "max_link_follow_policy",
    "ServiceTypeRepository": "incarnation",
}
OPERATIONS = {
    "Lookup": {
        "query": "IllegalServiceType UnknownServiceType IllegalConstraint IllegalPreference"
                 " IllegalPolicyName PolicyTypeMismatch InvalidPolicyValue IllegalPropertyName"
                 " DuplicatePropertyName DuplicatePolicyName",
    },
    "Register": {
        "export": "InvalidObjectRef IllegalServiceType UnknownServiceType InterfaceTypeMismatch"
                  " IllegalPropertyName PropertyTypeMismatch ReadonlyDynamicProperty"
                  " MissingMandatoryProperty DuplicatePropertyName",
        "withdraw": "IllegalOfferId UnknownOfferId ProxyOfferId",
        "describe": "IllegalOfferId UnknownOfferId ProxyOfferId",
        "modify": "NotImplemented IllegalOfferId UnknownOfferId ProxyOfferId IllegalPropertyName"
                  " UnknownPropertyName PropertyTypeMismatch ReadonlyDynamicProperty"
                  " MandatoryProperty ReadonlyProperty DuplicatePropertyName",
        "withdraw_using_constraint": "IllegalServiceType UnknownServiceType IllegalConstraint"
                                     " NoMatchingOffers",
        "resolve": "IllegalTraderName UnknownTraderName RegisterNotSupported",
    },
    "Link": {
        "add_link": "IllegalLinkName DuplicateLinkName InvalidLookupRef"
                    " DefaultFollowTooPermissive LimitingFollowTooPermissive",
        "remove_link": "IllegalLinkName UnknownLinkName",
        "describe_link": "IllegalLinkName UnknownLinkName",
        "list_links": "",
        "modify_link": "IllegalLinkName UnknownLinkName DefaultFollowTooPermissive"
                       " LimitingFollowTooPermissive",
    },
    "Proxy": {
        "export_proxy": "IllegalServiceType UnknownServiceType InvalidLookupRef"
                        " IllegalPropertyName PropertyTypeMismatch ReadonlyDynamicProperty"
                        " MissingMandatoryProperty IllegalRecipe DuplicatePropertyName"
                        " DuplicatePolicyName",
        "withdraw_proxy": "IllegalOfferId UnknownOfferId NotProxyOfferId",
        "describe_proxy": "IllegalOfferId UnknownOfferId NotProxyOfferId",
    },
    "Admin": {
        "request_id_stem": "",
        **{f"set_{name}": "" for name in (
            "def_search_card max_search_card def_match_card max_match_card def_return_card"
            " max_return_card max_list supports_modifiable_properties supports_dynamic_properties"
            " supports_proxy_offers def_hop_count max_hop_count def_follow_policy"
            " max_follow_policy max_link_follow_policy type_repos request_id_stem").split()},
        "list_offers": "NotImplemented",
        "list_proxies": "NotImplemented",
    },
    "OfferIterator": {"max_left": "UnknownMaxLeft", "next_n": "", "destroy": ""},
    "OfferIdIterator": {"max_left": "UnknownMaxLeft", "next_n": "", "destroy": ""},
    "ServiceTypeRepository": {
        "add_type": "IllegalServiceType ServiceTypeExists InterfaceTypeMismatch"
                    " IllegalPropertyName DuplicatePropertyName ValueTypeRedefinition"
                    " UnknownServiceType DuplicateServiceTypeName",
        "remove_type": "IllegalServiceType UnknownServiceType HasSubTypes",
        "list_types": "",
        "describe_type": "IllegalServiceType UnknownServiceType",
        "fully_describe_type": "IllegalServiceType UnknownServiceType",
        "mask_type": "IllegalServiceType UnknownServiceType AlreadyMasked",
        "unmask_type": "IllegalServiceType UnknownServiceType NotMasked",
    },
    "DynamicPropEval": {"evalDP": "DPEvalFailure"},
}
TEST = re.compile(r"^TEST(?:_F)?\((\w+), (\w+)\)(.*?)^}", re.M | re.S)


def read_tests(root):
    """Returns {SUITE.NAME: (body of the test, its file and its fixtures)}."""
    fixtures = "".join((root / "gsv/broker/testing" / name).read_text()
                       for name in ("broker_fixture.cc", "broker_node.h"))
    tests = {}
    for file in sorted(root.glob("gsv/broker/**/*_test.cc")):
        text = file.read_text()
        for suite, name, body in TEST.findall(text):
            tests[f"{suite}.{name}"] = (body, text + fixtures)
    return tests


def quoted(cell):
    return re.findall(r"`([^`]+)`", cell)


def read_rows(text):
    """Returns {(interface, operation): [(exceptions, whether the row says "never", tests)]}."""
    rows = {}
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if len(cells) != 3 or "::" not in cells[0]:
            continue
        interface = ""
        for name in quoted(cells[0]):
            if "::" in name:
                interface, name = name.split("::")
            rows.setdefault((interface, name), []).append(
                (quoted(cells[1]), "never" in cells[1], quoted(cells[2])))
    return rows


def problems(text, tests):
    rows = read_rows(text)
    wanted = {(interface, name): exceptions.split()
              for interface, operations in OPERATIONS.items()
              for name, exceptions in operations.items()}
    for interface, names in ATTRIBUTES.items():
        wanted.update({(interface, name): [] for name in names.split()})
    for (interface, operation), exceptions in wanted.items():
        what = f"{interface}::{operation}"
        own = rows.get((interface, operation), [])
        if not any(f"{operation}(" in tests.get(test, ("", ""))[1]
                   for _, _, named in own for test in named):
            yield f"{what}: no test that calls it"
        for exception in exceptions:
            shown = [(never, named) for raised, never, named in own if exception in raised]
            if not any(never or exception in tests.get(test, ("", ""))[0]
                       for never, named in shown for test in named):
                yield f"{what}: no test for {exception}"
    for (interface, operation), own in rows.items():
        for _, _, named in own:
            for test in named:
                if test not in tests:
                    yield f"{interface}::{operation}: there is no test {test}"


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    found = sorted(set(problems((root / "docs/broker.md").read_text(), read_tests(root))))
    for problem in found:
        print(problem)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
