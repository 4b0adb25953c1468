// A Scope stores properties and blocks, and a Space stores macros. Each can also access the
// contents of the scopes or spaces that contain it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/macro.h"
#include "gsv/formats/xacro/value.h"

namespace gsv::formats::xacro {

class Scope;

// A property of xacro. The text of a lazy property is evaluated at its first use, in the scope of
// its definition.
struct Property {
  Value value;
  NodePtr defined_at;  // the element that has set the property
  bool is_lazy = false;
  bool is_resolving = false;  // whether its text is being evaluated, to detect cycles
};

// The nodes that <xacro:insert_block> inserts.
struct Block {
  std::vector<NodePtr> nodes;
  bool is_expanded = false;  // whether the nodes are inserted as they are, without expansion
};

// Evaluates a text of the node `at`, with the properties of the scope.
using Resolve = std::function<base::Result<Value>(const std::string& text, const Node& at, Scope&)>;

// The properties and blocks that are visible at an element.
class Scope final : public Names {
 public:
  // `parent` must outlive this scope. It is null for the outermost scope.
  Scope(Scope* parent, const Resolve& resolve) : parent_(parent), resolve_(resolve) {}

  Scope* parent() { return parent_; }
  // The outermost scope, which has no parent.
  Scope& outermost() { return parent_ == nullptr ? *this : parent_->outermost(); }

  // Sets a property. Converts a text that is a number or truth value.
  void Set(const std::string& name, const Value& value, const NodePtr& at, bool is_lazy);
  // Removes a property of this scope.
  void Remove(const std::string& name) { properties_.erase(name); }
  // Whether this scope or a parent has the property.
  bool Has(const std::string& name) const;
  // Returns the value of a property of this scope or a parent; nullopt if there is none.
  base::Result<std::optional<Value>> Find(const std::string& name);
  std::optional<Value> Member(const std::string& name) const override;

  void SetBlock(const std::string& name, Block block) { blocks_[name] = std::move(block); }
  // Returns a block of this scope or a parent; null if there is none.
  const Block* FindBlock(const std::string& name) const;

 private:
  Scope* const parent_;
  const Resolve& resolve_;
  std::map<std::string, Property> properties_;
  std::map<std::string, Block> blocks_;
};

// A namespace: the properties and macros of a file, and the namespaces of files that it includes.
// Pointers to members stay valid.
struct Space {
  Space(Space* outer_space, Scope* outer_scope, const Resolve& resolve)
      : outer(outer_space), scope(outer_scope, resolve) {}

  // Returns the macro with that name, such as "wheel" or "arm.gripper", and the Space that contains
  // the macro.
  std::pair<const Macro*, Space*> FindMacro(const std::string& name);

  Space* const outer;  // the namespace that contains this one; null for the main file's
  Scope scope;
  std::map<std::string, Macro> macros;
  std::map<std::string, std::unique_ptr<Space>> spaces;  // namespaces of included files, by name
};

}  // namespace gsv::formats::xacro
