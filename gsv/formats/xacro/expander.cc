#include "gsv/formats/xacro/expander.h"

#include <algorithm>

namespace gsv::formats::xacro {
namespace {

constexpr int kMaxSteps = 1'000'000;
constexpr int kMaxLevels = 500;
constexpr std::size_t kMaxMessageLength = 600;

base::Failure<base::Error> InvalidXacro(const std::string& why) {
  return base::Fail(base::ErrorCode::kBadModel, why);
}

std::string WithoutPrefix(const std::string& name) {
  return name.starts_with("xacro:") ? name.substr(6) : name;
}

bool IsIdentifier(const std::string& name) {
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name.front())) == 0 &&
         std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c >= 0x80; });
}

// Whether this is the name of a URDF element. A macro of this name must be called with the prefix
// "xacro:".
bool IsOfUrdf(const std::string& name) {
  for (const char* known :
       {"link",   "joint",    "visual",   "collision", "inertial",     "inertia",
        "mass",   "origin",   "geometry", "mesh",      "box",          "cylinder",
        "sphere", "material", "color",    "parent",    "child",        "axis",
        "limit",  "gazebo",   "plugin",   "sensor",    "transmission", "robot"}) {
    if (name == known) return true;
  }
  return false;
}

void SetAttribute(Node& node, const std::string& name, const std::string& value) {
  for (auto& attribute : node.attributes) {
    if (attribute.first != name) continue;
    attribute.second = value;
    return;
  }
  node.attributes.emplace_back(name, value);
}

std::string Stripped(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

// Counts one level of the recursive expansion during its lifetime.
class Level {
 public:
  explicit Level(int& levels) : levels_(levels) { ++levels_; }
  ~Level() { --levels_; }
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;

 private:
  int& levels_;
};

}  // namespace

Expander::Expander(const ExpandOptions& options, base::Problems& problems)
    : problems_(problems),
      files_(options.finder, options.limits, problems),
      arguments_(options.arguments),
      resolve_([this](const std::string& text, const Node& at, Scope& scope) {
        return Evaluate(text, at, scope);
      }),
      main_(nullptr, nullptr, resolve_),
      max_include_depth_(options.limits.include_depth) {}

base::Result<NodePtr> Expander::Run(const NodePtr& root) {
  takes_plain_names_ = root->text == "robot";
  Node document;
  Context context{main_.scope, main_, 0, max_include_depth_};
  auto status = Plain(root->text, *root, document, context);
  if (!status) {
    base::Error error = status.error();
    if (error.where.empty()) error.where = root->place();
    if (!missing_file_.empty()) error.message += " (" + missing_file_ + " is missing)";
    return base::Fail(std::move(error));
  }
  return document.children.front();
}

base::Status Expander::Children(const Node& of, Node& parent, Context& context) {
  for (const NodePtr& child : of.children) {
    if (auto ok = One(child, parent, context); !ok) return ok;
  }
  return {};
}

base::Status Expander::One(const NodePtr& node, Node& parent, Context& context) {
  const Level level(levels_);
  base::Status status;
  if (++steps_ > kMaxSteps) {
    status =
        InvalidXacro("the file takes more than " + std::to_string(kMaxSteps) + " steps to expand");
  } else if (levels_ > kMaxLevels) {
    status = InvalidXacro("macros and elements are nested deeper than " +
                          std::to_string(kMaxLevels) + " levels");
  } else if (node->is_element) {
    status = Element(node, parent, context);
  } else if (const auto text = TextOf(node->text, *node, context.scope)) {
    auto leaf = std::make_shared<Node>(*node);
    leaf->text = *text;
    parent.children.push_back(std::move(leaf));
  } else {
    status = base::Fail(text.error());
  }
  if (!status && status.error().where.empty()) status.error().where = node->place();
  return status;
}

Expander::Handler Expander::HandlerOf(const Node& node, bool takes_plain_names) {
  struct Known {
    const char* name;
    Handler handler;
    // Without the prefix "xacro:", only an element with these attributes is an element of xacro.
    std::vector<const char*> attributes;
  };
  static const std::vector<Known> kKnown{
      {"property", &Expander::OnProperty, {"name", "value"}},
      {"macro", &Expander::OnMacro, {"name"}},
      {"arg", &Expander::OnArgument, {"name", "default"}},
      {"include", &Expander::OnInclude, {"filename"}},
      {"if", &Expander::OnCondition, {"value"}},
      {"unless", &Expander::OnCondition, {"value"}},
      {"insert_block", &Expander::OnInsertBlock, {"name"}},
      {"call", &Expander::OnCall, {"xacro:"}},
      {"element", &Expander::OnElement, {"xacro:"}},
      {"attribute", &Expander::OnAttribute, {"xacro:"}},
  };
  const bool is_prefixed = node.text.starts_with("xacro:");
  if (!is_prefixed && !takes_plain_names) return nullptr;
  const std::string name = WithoutPrefix(node.text);
  for (const Known& known : kKnown) {
    if (name != known.name) continue;
    const bool is_meant =
        std::all_of(known.attributes.begin(), known.attributes.end(),
                    [&](const char* each) { return node.attribute(each) != nullptr; }) &&
        !(name == "include" && !node.children.empty());
    if (is_prefixed || is_meant) return known.handler;
  }
  return nullptr;
}

base::Status Expander::Element(const NodePtr& node, Node& parent, Context& context) {
  const bool is_prefixed = node->text.starts_with("xacro:");
  const std::string name = WithoutPrefix(node->text);
  // A macro named "call" hides the element <xacro:call>, as it does in xacro.
  if (is_prefixed || (takes_plain_names_ && !IsOfUrdf(name))) {
    const auto [macro, home] = context.space.FindMacro(name);
    const bool is_call = macro != nullptr && (is_prefixed || LooksLikeCall(*node, *macro));
    if (is_call) return CallMacro(*macro, *home, node, parent, context);
  }
  if (const Handler handler = HandlerOf(*node, takes_plain_names_)) {
    return (this->*handler)(node, parent, context);
  }
  if (is_prefixed) return UnknownMacro(name, *node);
  return Plain(node->text, *node, parent, context);
}

// Handles the call of an unknown macro. If an included file is missing, it may define the macro.
// Then this call is left out with a warning, and the expansion continues.
base::Status Expander::UnknownMacro(const std::string& name, const Node& call) {
  if (missing_file_.empty()) return InvalidXacro("there is no macro \"" + name + "\"");
  problems_.push_back({base::Problem::Severity::kWarning,
                       "the call of the macro \"" + name + "\" is ignored: " + missing_file_ +
                           ", which was not found, may define it",
                       call.place()});
  return {};
}

// Whether the node is probably a call of the macro. Without the prefix "xacro:", the name is not
// sufficient: <camera> inside a macro "camera" is an element.
bool Expander::LooksLikeCall(const Node& node, const Macro& macro) const {
  if (active_.contains(macro.definition.get())) return false;
  if (!macro.definition->text.starts_with("xacro:")) return true;
  const auto& parameters = macro.parameters;
  const bool fits = std::all_of(parameters.begin(), parameters.end(), [&](const Parameter& each) {
    return each.kind != Parameter::Kind::kValue || each.otherwise || each.is_forwarded ||
           node.attribute(each.name) != nullptr;
  });
  return fits && !node.attributes.empty() &&
         std::all_of(node.attributes.begin(), node.attributes.end(), [&](const auto& given) {
           return std::any_of(
               parameters.begin(), parameters.end(),
               [&](const Parameter& parameter) { return parameter.name == given.first; });
         });
}

base::Status Expander::Plain(const std::string& name, const Node& node, Node& parent,
                             Context& context) {
  auto element = std::make_shared<Node>();
  element->text = name;
  element->file = node.file;
  element->line = node.line;
  element->call_line = context.line > 0 ? context.line : node.line;
  for (const auto& [key, value] : node.attributes) {
    if (key.starts_with("xmlns") || key.starts_with("xacro:")) continue;
    const auto text = TextOf(value, node, context.scope);
    if (!text) return base::Fail(text.error());
    element->attributes.emplace_back(key, *text);
  }
  auto status = Children(node, *element, context);
  parent.children.push_back(std::move(element));
  return status;
}

base::Status Expander::OnProperty(const NodePtr& node, Node&, Context& context) {
  Scope& scope = context.scope;
  const auto name = RequiredAttribute(*node, "name", scope);
  if (!name) return base::Fail(name.error());
  if (!IsIdentifier(*name))
    return InvalidXacro("\"" + *name + "\" cannot be the name of a property");
  const auto removes = FlagOf(*node, "remove", false, scope);
  if (!removes) return base::Fail(removes.error());
  if (*removes) {
    scope.Remove(*name);
    return {};
  }
  const std::string* value = node->attribute("value");
  if (value == nullptr && node->attribute("default") != nullptr) {
    if (scope.Has(*name)) return {};
    value = node->attribute("default");
  }
  const std::string reach = node->attribute("scope") == nullptr ? "" : *node->attribute("scope");
  if (reach != "" && reach != "parent" && reach != "global" && reach != "local") {
    return InvalidXacro("the scope of a property is local, parent or global, not \"" + reach +
                        "\"");
  }
  Scope* target = &scope;
  if (reach == "global") target = &scope.outermost();
  if (reach == "parent" && scope.parent() != nullptr) target = scope.parent();
  if (value == nullptr) {
    target->SetBlock(*name, {node->children, false});
    return {};
  }
  const auto lazy = FlagOf(*node, "lazy_eval", true, scope);
  if (!lazy) return base::Fail(lazy.error());
  if (*lazy && target == &scope && reach != "global") {
    target->Set(*name, {*value}, node, true);
    return {};
  }
  const auto evaluated = Evaluate(*value, *node, scope);
  if (!evaluated) return base::Fail(evaluated.error());
  target->Set(*name, *evaluated, node, false);
  return {};
}

base::Status Expander::OnMacro(const NodePtr& node, Node&, Context& context) {
  const std::string* name = node->attribute("name");
  if (name == nullptr || name->empty()) return InvalidXacro("the macro has no name");
  const std::string* parameters = node->attribute("params");
  context.space.macros[WithoutPrefix(*name)] = {
      node, parameters == nullptr ? std::vector<Parameter>() : ParseParameters(*parameters)};
  return {};
}

base::Status Expander::OnArgument(const NodePtr& node, Node&, Context& context) {
  const auto name = RequiredAttribute(*node, "name", context.scope);
  if (!name) return base::Fail(name.error());
  const std::string* otherwise = node->attribute("default");
  if (arguments_.contains(*name) || otherwise == nullptr) return {};
  const auto value = TextOf(*otherwise, *node, context.scope);
  if (!value) return base::Fail(value.error());
  arguments_[*name] = *value;
  return {};
}

base::Status Expander::OnInclude(const NodePtr& node, Node& parent, Context& context) {
  const auto name = RequiredAttribute(*node, "filename", context.scope);
  if (!name) return base::Fail(name.error());
  const auto is_optional = FlagOf(*node, "optional", false, context.scope);
  if (!is_optional) return base::Fail(is_optional.error());
  if (context.includes_left <= 0) {
    return InvalidXacro("files include each other deeper than " +
                        std::to_string(max_include_depth_) + " levels");
  }
  if (name->find_first_of("*?[") == std::string::npos) {
    return Include(*name, *is_optional, node, parent, context);
  }
  const auto matching = files_.Matching(*name, *node->file);
  if (matching.empty() && !*is_optional) {
    problems_.push_back({base::Problem::Severity::kWarning,
                         "no file matches the pattern \"" + *name + "\"; nothing is included",
                         node->place()});
  }
  for (const std::string& file : matching) {
    if (auto status = Include(file, *is_optional, node, parent, context); !status) return status;
  }
  return {};
}

base::Status Expander::Include(const std::string& name, bool is_optional, const NodePtr& node,
                               Node& parent, Context& context) {
  const auto root = files_.ReadIncluded(name, *node->file);
  if (!root) {
    if (!is_optional && root.error().code != base::ErrorCode::kNotFound) {
      return base::Fail(root.error());
    }
    if (!is_optional) missing_file_ = name;
    problems_.push_back({base::Problem::Severity::kWarning,
                         (is_optional ? "the optional file is ignored: "
                                      : "the include of " + name + " is ignored: ") +
                             root.error().message,
                         node->place()});
    return {};
  }
  Space* space = &context.space;
  Scope* scope = &context.scope;
  if (const std::string* written = node->attribute("ns")) {
    const auto spelled = TextOf(*written, *node, context.scope);
    if (!spelled) return base::Fail(spelled.error());
    auto& named = context.space.spaces[*spelled];
    named = std::make_unique<Space>(&context.space, &context.scope, resolve_);
    space = named.get();
    scope = &named->scope;
    context.scope.Set(*spelled, {static_cast<const Names*>(scope)}, node, false);
  }
  Context inner{*scope, *space, context.line > 0 ? context.line : node->line,
                context.includes_left - 1};
  return Children(**root, parent, inner);
}

base::Status Expander::OnCondition(const NodePtr& node, Node& parent, Context& context) {
  const std::string* text = node->attribute("value");
  if (text == nullptr)
    return InvalidXacro("<xacro:if> and <xacro:unless> need the attribute value");
  const auto value = Evaluate(*text, *node, context.scope);
  if (!value) return base::Fail(value.error());
  const auto condition = ConditionOf(*value);
  if (!condition) {
    return InvalidXacro("the condition \"" + *text + "\" gives \"" + ToText(*value) +
                        "\", which is neither true nor false");
  }
  const bool keeps = *condition != (WithoutPrefix(node->text) == "unless");
  return keeps ? Children(*node, parent, context) : base::Status();
}

base::Status Expander::OnInsertBlock(const NodePtr& node, Node& parent, Context& context) {
  const auto name = RequiredAttribute(*node, "name", context.scope);
  if (!name) return base::Fail(name.error());
  const Block* const found = context.scope.FindBlock(*name);
  if (found == nullptr) return InvalidXacro("there is no block \"" + *name + "\"");
  const Block block = *found;  // a copy, because the expansion may replace the block
  if (block.is_expanded) {
    steps_ += static_cast<int>(block.nodes.size());
    parent.children.insert(parent.children.end(), block.nodes.begin(), block.nodes.end());
    return {};
  }
  Node holder;
  holder.children = block.nodes;
  return Children(holder, parent, context);
}

base::Status Expander::OnCall(const NodePtr& node, Node& parent, Context& context) {
  const auto name = RequiredAttribute(*node, "macro", context.scope);
  if (!name) return base::Fail(name.error());
  const auto [macro, home] = context.space.FindMacro(WithoutPrefix(*name));
  if (macro == nullptr) return UnknownMacro(*name, *node);
  auto call = std::make_shared<Node>(*node);
  std::erase_if(call->attributes, [](const auto& each) { return each.first == "macro"; });
  return CallMacro(*macro, *home, call, parent, context);
}

base::Status Expander::OnElement(const NodePtr& node, Node& parent, Context& context) {
  const auto name = RequiredAttribute(*node, "xacro:name", context.scope);
  if (!name) return base::Fail(name.error());
  if (!IsIdentifier(*name))
    return InvalidXacro("\"" + *name + "\" cannot be the name of an element");
  return Plain(*name, *node, parent, context);
}

base::Status Expander::OnAttribute(const NodePtr& node, Node& parent, Context& context) {
  const auto name = RequiredAttribute(*node, "name", context.scope);
  if (!name) return base::Fail(name.error());
  const auto value = RequiredAttribute(*node, "value", context.scope);
  if (!value) return base::Fail(value.error());
  if (!IsIdentifier(*name))
    return InvalidXacro("\"" + *name + "\" cannot be the name of an attribute");
  SetAttribute(parent, *name, *value);
  return {};
}

base::Status Expander::CallMacro(const Macro& macro, Space& home, const NodePtr& node, Node& parent,
                                 Context& context) {
  const NodePtr definition = macro.definition;  // a copy, because the body may redefine it
  Scope inner(&home == &main_ || &home == &context.space ? &context.scope : &home.scope, resolve_);
  if (auto ok = BindValues(macro, node, context, inner); !ok) return ok;
  if (auto ok = BindBlocks(macro, node, context, inner); !ok) return ok;
  Context body{inner, home, context.line > 0 ? context.line : node->line, context.includes_left};
  const bool is_outermost = active_.insert(definition.get()).second;
  auto status = Children(*definition, parent, body);
  if (is_outermost) active_.erase(definition.get());
  if (!status && status.error().message.size() < kMaxMessageLength) {
    status.error().message +=
        ", in the macro " + WithoutPrefix(node->text) + " called at " + node->place();
  }
  return status;
}

base::Status Expander::BindValues(const Macro& macro, const NodePtr& node, Context& context,
                                  Scope& inner) {
  std::map<std::string, Value> given;
  for (const auto& attribute : node->attributes) {
    const std::string& name = attribute.first;
    const bool is_taken =
        std::any_of(macro.parameters.begin(), macro.parameters.end(), [&](const auto& parameter) {
          return parameter.name == name && parameter.kind == Parameter::Kind::kValue;
        });
    if (!is_taken) return InvalidXacro("the macro has no parameter \"" + name + "\"");
    auto value = Evaluate(attribute.second, *node, context.scope);
    if (!value) return base::Fail(value.error());
    given[name] = *std::move(value);
  }
  for (const Parameter& parameter : macro.parameters) {
    if (parameter.kind != Parameter::Kind::kValue) continue;
    if (const auto it = given.find(parameter.name); it != given.end()) {
      inner.Set(parameter.name, it->second, node, false);
    } else if (auto ok = BindDefault(parameter, node, context, inner); !ok) {
      return ok;
    }
  }
  return {};
}

base::Status Expander::BindDefault(const Parameter& parameter, const NodePtr& node,
                                   Context& context, Scope& inner) {
  if (parameter.is_forwarded) {
    const auto value = context.scope.Find(parameter.name);
    if (!value) return base::Fail(value.error());
    if (*value) {
      inner.Set(parameter.name, **value, node, false);
      return {};
    }
  }
  if (!parameter.otherwise) {
    return InvalidXacro("the call lacks the parameter \"" + parameter.name + "\"");
  }
  // The default of a parameter may use the properties of the macro's namespace.
  const auto value = Evaluate(*parameter.otherwise, *node, *inner.parent());
  if (!value) return base::Fail(value.error());
  inner.Set(parameter.name, *value, node, false);
  return {};
}

base::Status Expander::BindBlocks(const Macro& macro, const NodePtr& node, Context& context,
                                  Scope& inner) {
  Node holder;
  if (auto ok = Children(*node, holder, context); !ok) return ok;
  std::erase_if(holder.children, [](const NodePtr& child) { return !child->is_element; });
  auto block = holder.children.begin();
  for (const Parameter& parameter : macro.parameters) {
    if (parameter.kind == Parameter::Kind::kValue) continue;
    if (block == holder.children.end()) {
      return InvalidXacro("the call lacks an element for the block \"" + parameter.name + "\"");
    }
    const NodePtr element = *block++;
    const bool is_whole = parameter.kind == Parameter::Kind::kBlock;
    inner.SetBlock(parameter.name,
                   {is_whole ? std::vector<NodePtr>{element} : element->children, true});
  }
  if (block == holder.children.end()) return {};
  return InvalidXacro("the macro has no block parameter for the element <" + (*block)->text + ">");
}

base::Result<Value> Expander::Evaluate(const std::string& text, const Node& at, Scope& scope) {
  if (text.find('$') == std::string::npos) return Value{text};
  if (++steps_ > kMaxSteps) {
    return InvalidXacro("the file takes more than " + std::to_string(kMaxSteps) +
                        " steps to expand");
  }
  const Level level(levels_);
  if (levels_ > kMaxLevels)
    return InvalidXacro("macros and properties are nested deeper than " +
                        std::to_string(kMaxLevels) +
                        " levels. Check for a macro that always calls itself");
  EvaluationContext evaluation;
  evaluation.property = [&](const std::string& name) { return scope.Find(name); };
  evaluation.load_yaml = [&](const std::string& name) { return files_.ReadYaml(name, *at.file); };
  evaluation.argument = [&](const std::string& name) { return ArgumentNamed(name); };
  evaluation.report = [&](const std::string& said) {
    problems_.push_back({base::Problem::Severity::kWarning, said, at.place()});
  };
  return Substitute(text, evaluation,
                    [&](const std::string& command) { return Command(command, at, scope); });
}

base::Result<std::string> Expander::TextOf(const std::string& text, const Node& at, Scope& scope) {
  const auto value = Evaluate(text, at, scope);
  if (!value) return base::Fail(value.error());
  return ToText(*value);
}

base::Result<std::string> Expander::RequiredAttribute(const Node& node, const char* name,
                                                      Scope& scope) {
  const std::string* text = node.attribute(name);
  if (text == nullptr) return InvalidXacro("<" + node.text + "> needs the attribute " + name);
  auto value = TextOf(*text, node, scope);
  if (value && value->empty() && std::string(name) != "value") {
    return InvalidXacro("<" + node.text + "> has an empty attribute " + name);
  }
  return value;
}

base::Result<bool> Expander::FlagOf(const Node& node, const char* name, bool otherwise,
                                    Scope& scope) {
  const std::string* text = node.attribute(name);
  if (text == nullptr) return otherwise;
  const auto value = Evaluate(*text, node, scope);
  if (!value) return base::Fail(value.error());
  const auto flag = ConditionOf(*value);
  if (!flag)
    return InvalidXacro(std::string(name) + " must be true or false, not " + ToText(*value));
  return *flag;
}

base::Result<Value> Expander::Command(const std::string& command, const Node& at, Scope& scope) {
  const std::size_t blank = std::min(command.find_first_of(" \t\n"), command.size());
  const std::string name = command.substr(0, blank), rest = Stripped(command.substr(blank));
  if (name == "arg") return ArgumentNamed(rest);
  if (name == "find" || name == "find-pkg-share") {
    const auto folder = files_.Package(rest, *at.file);
    if (folder) return Value{folder->string()};
    if (missing_packages_.insert(rest).second) {
      problems_.push_back({base::Problem::Severity::kWarning, folder.error().message, at.place()});
    }
    return Value{"package://" + rest};  // the element that uses the name later reports the missing
                                        // package
  }
  if (name == "dirname") return Value{at.file->parent_path().string()};
  if (name == "eval") {
    EvaluationContext evaluation;
    evaluation.property = [&](const std::string& word) -> base::Result<std::optional<Value>> {
      const auto argument = arguments_.find(word);
      if (argument != arguments_.end()) return FromLiteral(argument->second);
      return scope.Find(word);
    };
    evaluation.argument = [&](const std::string& word) { return ArgumentNamed(word); };
    return xacro::Evaluate(rest, evaluation);
  }
  if (name == "optenv") {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    problems_.push_back({base::Problem::Severity::kWarning,
                         "$(optenv " + rest.substr(0, end) +
                             ") uses its default: environment variables are not read",
                         at.place()});
    return Value{Stripped(rest.substr(end))};
  }
  return InvalidXacro(
      "$(" + name + " …) is not supported" +
      (name == "env" ? ": environment variables are not read; use an argument" : ""));
}

base::Result<Value> Expander::ArgumentNamed(const std::string& name) const {
  const auto it = arguments_.find(name);
  if (it != arguments_.end()) return Value{it->second};
  return InvalidXacro("the argument \"" + name +
                      "\" has no default; append it to the file's name, as " + "robot.urdf.xacro?" +
                      name + "=VALUE");
}

}  // namespace gsv::formats::xacro
