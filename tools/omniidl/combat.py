"""A back end of omniidl that describes IDL to Combat, an ORB for Tcl.

    omniidl -ptools/omniidl -bcombat FILE.idl > FILE.tcl

prints a script that fills Combat's interface repository with `combat::ir add`. Combat's own idl2tcl
prints such a script too, but it needs a running interface repository. The script includes the content of included
files, so it needs no other script. Value types and local interfaces are refused.
"""

import sys

from omniidl import idlast, idltype

USAGE = "  (no arguments)"

SIMPLE = {
    idltype.tk_void: "void",
    idltype.tk_short: "short",
    idltype.tk_long: "long",
    idltype.tk_ushort: "unsigned short",
    idltype.tk_ulong: "unsigned long",
    idltype.tk_float: "float",
    idltype.tk_double: "double",
    idltype.tk_boolean: "boolean",
    idltype.tk_char: "char",
    idltype.tk_octet: "octet",
    idltype.tk_any: "any",
    idltype.tk_TypeCode: "TypeCode",
    idltype.tk_longlong: "long long",
    idltype.tk_ulonglong: "unsigned long long",
    idltype.tk_longdouble: "long double",
    idltype.tk_wchar: "wchar",
}


def tcl(item):
    """Returns a Python list or text as one word of a Tcl list."""
    text = item if isinstance(item, str) else " ".join(tcl(each) for each in item)
    plain = text and not any(c in ' \t\n{}"\\$[];#' for c in text)
    if plain and (isinstance(item, str) or len(item) == 1):
        return text
    if isinstance(item, str) and any(c in '{}\\' for c in text):
        return "".join("\\" + c if c in ' {}"\\$[];#' else c for c in text)
    return "{" + text + "}"


def identity(node):
    return [node.repoId(), node.identifier(), node.repoId().rsplit(":", 1)[-1]]


def type_of(kind, sizes=()):
    """Returns the type in Combat's notation: a name, a repository identifier, or a list."""
    result = plain_type(kind)
    for size in reversed(list(sizes)):
        result = ["array", result, str(size)]
    return result


def plain_type(kind):
    if kind.kind() in SIMPLE:
        return SIMPLE[kind.kind()]
    if kind.kind() in (idltype.tk_string, idltype.tk_wstring):
        name = "string" if kind.kind() == idltype.tk_string else "wstring"
        return [name, str(kind.bound())] if kind.bound() else name
    if kind.kind() == idltype.tk_sequence:
        bound = [str(kind.bound())] if kind.bound() else []
        return ["sequence", type_of(kind.seqType())] + bound
    if kind.kind() == idltype.tk_objref and kind.scopedName() == ["CORBA", "Object"]:
        return "Object"
    if isinstance(kind, idltype.Declared):
        return kind.decl().repoId()
    raise ValueError("Combat knows no such type: %s" % kind)


def members_of(node):
    return [[declarator.identifier(), type_of(member.memberType(), declarator.sizes())]
            for member in node.members() for declarator in member.declarators()]


def constructed_in(node):
    """Returns the types that are declared inside a member's type."""
    return [item for member in node.members() if member.constrType()
            for item in items_of(member.memberType().decl())]


def label_of(label, discriminator):
    if label.default():
        return "(default)"
    value = label.value()
    return value.identifier() if isinstance(value, idlast.Enumerator) else literal(value)


def literal(value):
    if isinstance(value, bool):
        return "1" if value else "0"
    return value.identifier() if isinstance(value, idlast.Enumerator) else str(value)


def union(node):
    cases = [[label_of(label, node.switchType()), case.declarator().identifier(),
              type_of(case.caseType(), case.declarator().sizes())]
             for case in node.cases() for label in case.labels()]
    within = [item for case in node.cases() if case.constrType()
              for item in items_of(case.caseType().decl())]
    return ["union", identity(node), type_of(node.switchType()), cases, within]


def operation(node):
    parameters = [[("in", "out", "inout")[parameter.direction()], parameter.identifier(),
                   type_of(parameter.paramType())] for parameter in node.parameters()]
    item = ["operation", identity(node), type_of(node.returnType()), parameters,
            [exception.repoId() for exception in node.raises()]]
    return item + ["oneway"] if node.oneway() else item


def attribute(node):
    mode = ["readonly"] if node.readonly() else []
    return [["attribute", identity(declarator), type_of(node.attrType())] + mode
            for declarator in node.declarators()]


def interface(node):
    if node.local():
        raise ValueError("%s: Combat knows no local interfaces" % node.identifier())
    kind = "abstractinterface" if node.abstract() else "interface"
    contents = [item for content in node.contents() for item in items_of(content)]
    return [kind, identity(node), [base.repoId() for base in node.inherits()], contents]


def items_of(node):
    if isinstance(node, idlast.Module):
        contents = [item for each in node.definitions() for item in items_of(each)]
        return [["module", identity(node), contents]]
    if isinstance(node, idlast.Forward):
        return [["interface", identity(node)]]
    if isinstance(node, (idlast.StructForward, idlast.UnionForward)):
        return []
    if isinstance(node, idlast.Interface):
        return [interface(node)]
    if isinstance(node, idlast.Operation):
        return [operation(node)]
    if isinstance(node, idlast.Attribute):
        return attribute(node)
    if isinstance(node, idlast.Const):
        return [["const", identity(node), type_of(node.constType()), literal(node.value())]]
    if isinstance(node, idlast.Typedef):
        within = items_of(node.aliasType().decl()) if node.constrType() else []
        return within + [["typedef", identity(declarator),
                          type_of(node.aliasType(), declarator.sizes())]
                         for declarator in node.declarators()]
    if isinstance(node, (idlast.Struct, idlast.Exception)):
        kind = "struct" if isinstance(node, idlast.Struct) else "exception"
        return [[kind, identity(node), members_of(node), constructed_in(node)]]
    if isinstance(node, idlast.Union):
        return [union(node)]
    if isinstance(node, idlast.Enum):
        return [["enum", identity(node), [each.identifier() for each in node.enumerators()]]]
    raise ValueError("%s: Combat is not told of value types" % node.identifier())


def run(tree, arguments):
    try:
        items = [item for node in tree.declarations() for item in items_of(node)]
    except ValueError as error:
        sys.exit("omniidl: %s" % error)
    print("# Made from %s by omniidl -bcombat. Do not edit." % tree.file().rsplit("/", 1)[-1])
    print("package require combat")
    print("combat::ir add {\n%s\n}" % "\n".join(tcl(item) for item in items))
