"""A back end of omniidl that prints the interfaces of IDL as JSON.

    omniidl -ptests/giop -bsignatures FILE.idl

    {REPOSITORY ID: {"name": "sba::Sonar", "bases": [REPOSITORY ID …],
                     "operations": [{"name", "parameters": [["in", NAME, TYPE] …], "result": TYPE}]}}

An attribute is listed as its operations `_get_…` and `_set_…`. A TYPE is the name of a simple type, or a list:
["sequence", TYPE], ["struct", ID, [[NAME, TYPE] …]], ["enum", ID, [NAME …]], ["objref", ID],
["union", ID, TYPE, {VALUE: [NAME, TYPE]}]. The output contains the content of included files.
"""

import json

from omniidl import idlast, idltype

SIMPLE = {
    idltype.tk_void: "void", idltype.tk_short: "short", idltype.tk_long: "long", idltype.tk_ushort: "ushort",
    idltype.tk_ulong: "ulong", idltype.tk_float: "float", idltype.tk_double: "double",
    idltype.tk_boolean: "boolean", idltype.tk_char: "char", idltype.tk_octet: "octet", idltype.tk_any: "any",
    idltype.tk_TypeCode: "TypeCode", idltype.tk_longlong: "longlong", idltype.tk_ulonglong: "ulonglong",
    idltype.tk_string: "string",
}


def type_of(kind):
    kind = kind.unalias()
    if kind.kind() in SIMPLE:
        return SIMPLE[kind.kind()]
    if kind.kind() == idltype.tk_sequence:
        return ["sequence", type_of(kind.seqType())]
    if kind.kind() == idltype.tk_objref:
        return ["objref", "" if kind.scopedName() == ["CORBA", "Object"] else kind.decl().repoId()]
    node = kind.decl()
    if isinstance(node, idlast.Enum):
        return ["enum", node.repoId(), [each.identifier() for each in node.enumerators()]]
    if isinstance(node, idlast.Struct):
        return ["struct", node.repoId(), [[declarator.identifier(), type_of(member.memberType())]
                                          for member in node.members() for declarator in member.declarators()]]
    if isinstance(node, idlast.Union):
        cases = {label.value().identifier(): [case.declarator().identifier(), type_of(case.caseType())]
                 for case in node.cases() for label in case.labels()}
        return ["union", node.repoId(), type_of(node.switchType()), cases]
    raise ValueError(f"no such type is expected here: {kind}")


def operations_of(node):
    if isinstance(node, idlast.Operation):
        parameters = [[("in", "out", "inout")[each.direction()], each.identifier(), type_of(each.paramType())]
                      for each in node.parameters()]
        return [{"name": node.identifier(), "parameters": parameters, "result": type_of(node.returnType())}]
    if not isinstance(node, idlast.Attribute):
        return []
    kind = type_of(node.attrType())
    found = []
    for each in node.declarators():
        found.append({"name": f"_get_{each.identifier()}", "parameters": [], "result": kind})
        if not node.readonly():
            found.append({"name": f"_set_{each.identifier()}", "parameters": [["in", "value", kind]],
                          "result": "void"})
    return found


def run(tree, arguments):
    interfaces = {}

    def visit(nodes):
        for node in nodes:
            if isinstance(node, idlast.Module):
                visit(node.definitions())
            elif isinstance(node, idlast.Interface):
                interfaces[node.repoId()] = {
                    "name": "::".join(node.scopedName()), "bases": [base.repoId() for base in node.inherits()],
                    "operations": [each for content in node.contents() for each in operations_of(content)]}

    visit(tree.declarations())
    print(json.dumps(interfaces))
