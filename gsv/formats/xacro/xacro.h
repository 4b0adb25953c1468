// Expands xacro files: macros, properties, conditions, includes and expressions become plain XML.
//
// Supported  property (value, default, remove, scope parent and global, lazy_eval; blocks), macro
//            with parameters (defaults, ^ forwarding, *block, **block), calls of macros,
//            xacro:call, insert_block, include (relative, $(find package), patterns, ns, optional),
//            if, unless, arg, element, attribute; $(arg), $(find), $(eval), $(dirname), $(optenv)
//            with its default; xacro.load_yaml. Also the old form without the prefix "xacro:".
// Refused    with an error that has the reason, file and line: $(env), $(anon), $(cwd), and
//            expressions that expression_parser.h and operators.h do not support.
// Limits     1,000,000 expanded nodes and texts, 500 levels of nested elements, macros and
//            properties, 512 includes; sizes, and the depth of includes: see ReadLimits.
// Source     the behaviour of ros/xacro, which processes a file from top to bottom ("in-order").
// Threads    any. The result depends only on the files and arguments.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <tinyxml2.h>

#include "gsv/base/error.h"
#include "gsv/formats/files/read_limits.h"
#include "gsv/formats/files/resource_finder.h"
#include "gsv/formats/support/element_path.h"

namespace gsv::formats::xacro {

// Whether a file must be expanded: its name ends in .xacro, or it has elements of xacro.
bool NeedsExpansion(const tinyxml2::XMLElement& root, const std::filesystem::path& file);

// Options of Expand().
struct ExpandOptions {
  const ResourceFinder& finder;
  const ReadLimits& limits;
  std::map<std::string, std::string> arguments;  // values that override the defaults of <xacro:arg>
};

// The result of Expand().
struct Expansion {
  // The expanded XML. An element is on its line in the main file, or on a later line if the text is
  // already longer. An element of a macro or of an included file is on the line of the macro call
  // or include in the main file.
  std::string xml;
  // The origin of each element, in the order of the document.
  std::vector<ElementSource> sources;
};

// Expands the elements below `root`, the root of `file`. Errors: kBadModel with file and line.
base::Result<Expansion> Expand(const tinyxml2::XMLElement& root, const std::filesystem::path& file,
                               const ExpandOptions& options, base::Problems& problems);

}  // namespace gsv::formats::xacro
