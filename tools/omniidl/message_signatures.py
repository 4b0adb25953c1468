"""A back end of omniidl that prints the input of gsv/orb/giop/message_check.h: the types of operations
and exceptions that pass an `any` or a TypeCode.

    omniidl -ptools/omniidl -bmessage_signatures -Wbfunction=NAMESPACE::NAME -Wbheader=PATH FILE.idl

prints a C++ source that includes the header PATH and defines the function NAME, which that header
declares and which returns `const orb::Signatures&`. The other operations are left out, because
their messages need no check. A message contains the name of its operation, but not of its interface.
Therefore two operations with the same name that both need a check must have the same types.
"""

import sys

from omniidl import idlast, idltype

USAGE = """  -Wbfunction=NAMESPACE::NAME  the function to define
  -Wbheader=PATH               the header that declares it"""

SIMPLE = {
    idltype.tk_void: "",
    idltype.tk_boolean: "1", idltype.tk_char: "1", idltype.tk_octet: "1",
    idltype.tk_short: "2", idltype.tk_ushort: "2",
    idltype.tk_long: "4", idltype.tk_ulong: "4", idltype.tk_float: "4", idltype.tk_enum: "4",
    idltype.tk_longlong: "8", idltype.tk_ulonglong: "8", idltype.tk_double: "8",
    idltype.tk_string: "s", idltype.tk_objref: "o", idltype.tk_any: "a", idltype.tk_TypeCode: "t",
}


def types_of(kind):
    """Returns the signature of a type: a text that encodes the type without its names."""
    kind = kind.unalias()
    if kind.kind() in SIMPLE:
        return SIMPLE[kind.kind()]
    if kind.kind() == idltype.tk_sequence:
        return "[%s]" % types_of(kind.seqType())
    node = kind.decl() if isinstance(kind, idltype.Declared) else None
    if isinstance(node, idlast.Struct):
        return members_of(node)
    if isinstance(node, idlast.Union):
        return union(node)
    raise ValueError("message_signatures does not know the type %s" % kind)


def members_of(node):
    """Returns the signature of the members of a struct or an exception."""
    types = ""
    for member in node.members():
        for declarator in member.declarators():
            if declarator.sizes():
                raise ValueError("message_signatures does not know arrays: %s" % declarator.identifier())
            types += types_of(member.memberType())
    return types


def union(node):
    size = types_of(node.switchType())
    members, default = "", ""
    for case in node.cases():
        for label in case.labels():
            member = "%s:%s;" % (label_of(label), types_of(case.caseType()))
            if label.default():
                default = member
            else:
                members += member
    return "<%s;%s%s>" % (size, members, default)


def label_of(label):
    if label.default():
        return "*"
    value = label.value()
    if isinstance(value, idlast.Enumerator):
        value = value.value()
    if not isinstance(value, int) or value < 0:
        raise ValueError("message_signatures does not know the label %s" % value)
    return str(int(value))


def is_checked(types):
    return "a" in types or "t" in types


class Tables:
    """The tables {name: signature} of the requests, replies and exceptions that need a check."""

    def __init__(self, nodes):
        self.requests, self.replies, self.exceptions = {}, {}, {}
        self.visit(nodes)

    def visit(self, nodes):
        for node in nodes:
            if isinstance(node, idlast.Module):
                self.visit(node.definitions())
            elif isinstance(node, idlast.Interface):
                self.visit(node.contents())
            elif isinstance(node, idlast.Exception):
                self.add(self.exceptions, node.repoId(), members_of(node))
            elif isinstance(node, idlast.Operation):
                self.add(self.requests, node.identifier(), arguments_of(node))
                self.add(self.replies, node.identifier(), results_of(node))
            elif isinstance(node, idlast.Attribute):
                self.add_attribute(node)

    def add_attribute(self, node):
        for each in node.declarators():
            self.add(self.replies, "_get_" + each.identifier(), types_of(node.attrType()))
            if not node.readonly():
                self.add(self.requests, "_set_" + each.identifier(), types_of(node.attrType()))

    def add(self, table, name, types):
        if is_checked(types) and table.setdefault(name, types) != types:
            raise ValueError("two operations %s pass different types: %s and %s" % (name, table[name], types))


def arguments_of(operation):
    return "".join(types_of(each.paramType()) for each in operation.parameters() if each.is_in())


def results_of(operation):
    return types_of(operation.returnType()) + "".join(
        types_of(each.paramType()) for each in operation.parameters() if each.is_out())


def array(name, table):
    entries = "\n".join('    {"%s", "%s"},' % each for each in sorted(table.items()))
    return "constexpr orb::Signature %s[] = {\n%s\n};\n" % (name, entries)


def run(tree, arguments):
    options = dict(each.split("=", 1) for each in arguments)
    namespace, function = options["function"].rsplit("::", 1)
    try:
        tables = Tables(tree.declarations())
    except ValueError as error:
        sys.exit("omniidl: %s" % error)
    print("""// Made from %s by omniidl -bmessage_signatures. Do not edit.
#include "%s"

namespace %s {
namespace {

%s
%s
%s
constexpr orb::Signatures kSignatures{kRequests, kReplies, kExceptions};

}  // namespace

const orb::Signatures& %s() { return kSignatures; }

}  // namespace %s""" % (
        tree.file().rsplit("/", 1)[-1], options["header"], namespace, array("kRequests", tables.requests),
        array("kReplies", tables.replies), array("kExceptions", tables.exceptions), function, namespace))
