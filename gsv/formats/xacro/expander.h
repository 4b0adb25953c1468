// An Expander expands the elements of a xacro file.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "gsv/formats/xacro/file_access.h"
#include "gsv/formats/xacro/scope.h"
#include "gsv/formats/xacro/substitution.h"
#include "gsv/formats/xacro/xacro.h"

namespace gsv::formats::xacro {

// Expands the elements of a xacro file.
class Expander {
 public:
  Expander(const ExpandOptions& options, base::Problems& problems);

  // Returns the expanded root element of a file.
  base::Result<NodePtr> Run(const NodePtr& root);

 private:
  // The state of the expansion at an element.
  struct Context {
    Scope& scope;  // the properties that are visible here
    Space& space;  // the macros that are visible here
    // The line of the include or macro call in the main file through which the expansion came here;
    // 0 if the element is in the main file itself. Then errors give the element's own line.
    int line = 0;
    int includes_left = 0;  // number of further levels of nested includes that are allowed
  };
  // A function that expands one kind of element, and appends the result to `parent`.
  using Handler = base::Status (Expander::*)(const NodePtr&, Node& parent, Context&);

  // Expands the children of a node, and appends the results to `parent`.
  base::Status Children(const Node& of, Node& parent, Context& context);
  // Expands one node.
  base::Status One(const NodePtr& node, Node& parent, Context& context);
  // Expands one element.
  base::Status Element(const NodePtr& node, Node& parent, Context& context);
  // Returns the function for an element of xacro; null for other elements.
  static Handler HandlerOf(const Node& node, bool takes_plain_names);
  // Whether the node is probably a call of the macro.
  bool LooksLikeCall(const Node& node, const Macro& macro) const;
  // Handles the call of an unknown macro.
  base::Status UnknownMacro(const std::string& name, const Node& call);
  // Appends an element that is not an element of xacro, with its attributes and content expanded.
  base::Status Plain(const std::string& name, const Node& node, Node& parent, Context& context);

  // Expands <xacro:property>.
  base::Status OnProperty(const NodePtr& node, Node& parent, Context& context);
  // Expands <xacro:macro>: stores the definition.
  base::Status OnMacro(const NodePtr& node, Node& parent, Context& context);
  // Expands <xacro:arg>: sets the default of an argument.
  base::Status OnArgument(const NodePtr& node, Node& parent, Context& context);
  // Expands <xacro:include>.
  base::Status OnInclude(const NodePtr& node, Node& parent, Context& context);
  // Expands an included file.
  base::Status Include(const std::string& name, bool is_optional, const NodePtr& node, Node& parent,
                       Context& context);
  // Expands <xacro:if> or <xacro:unless>.
  base::Status OnCondition(const NodePtr& node, Node& parent, Context& context);
  // Expands <xacro:insert_block>.
  base::Status OnInsertBlock(const NodePtr& node, Node& parent, Context& context);
  // Expands <xacro:call>.
  base::Status OnCall(const NodePtr& node, Node& parent, Context& context);
  // Expands <xacro:element>.
  base::Status OnElement(const NodePtr& node, Node& parent, Context& context);
  // Expands <xacro:attribute>.
  base::Status OnAttribute(const NodePtr& node, Node& parent, Context& context);

  // Expands the call of a macro. `home` is the Space that defines the macro.
  base::Status CallMacro(const Macro& macro, Space& home, const NodePtr& node, Node& parent,
                         Context& context);
  // Sets the value parameters of a macro in `inner`, the scope of its body.
  base::Status BindValues(const Macro& macro, const NodePtr& node, Context& context, Scope& inner);
  // Sets a parameter to its default.
  base::Status BindDefault(const Parameter& parameter, const NodePtr& node, Context& context,
                           Scope& inner);
  // Sets the block parameters of a macro.
  base::Status BindBlocks(const Macro& macro, const NodePtr& node, Context& context, Scope& inner);

  // Returns the value of a text, with all ${…} and $(…) substituted.
  base::Result<Value> Evaluate(const std::string& text, const Node& at, Scope& scope);
  // Returns the text with all substitutions made.
  base::Result<std::string> TextOf(const std::string& text, const Node& at, Scope& scope);
  // Returns an attribute's value; kBadModel if it is missing.
  base::Result<std::string> RequiredAttribute(const Node& node, const char* name, Scope& scope);
  // Returns an attribute's truth value, or `otherwise` if it is missing.
  base::Result<bool> FlagOf(const Node& node, const char* name, bool otherwise, Scope& scope);
  // Evaluates a $(command).
  base::Result<Value> Command(const std::string& command, const Node& at, Scope& scope);
  // Returns the value of $(arg name).
  base::Result<Value> ArgumentNamed(const std::string& name) const;

  base::Problems& problems_;
  FileAccess files_;                              // reads the files that the main file names
  std::map<std::string, std::string> arguments_;  // values of $(arg), by name
  const Resolve resolve_;                         // evaluates texts of lazy properties
  Space main_;                                    // the outermost namespace
  bool takes_plain_names_ = false;                // whether <macro> means <xacro:macro>
  std::set<const Node*> active_;                  // definitions of macros that are being expanded
  std::string missing_file_;  // the last include that was not found; empty if all were found
  std::set<std::string> missing_packages_;  // ROS packages that were not found
  // The number of nodes and texts that were expanded so far; the number of nested expansions now;
  // the maximum number of nested includes.
  int steps_ = 0, levels_ = 0, max_include_depth_;
};

}  // namespace gsv::formats::xacro
