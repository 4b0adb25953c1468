// The large templates of the JSON library, compiled once (json_templates.cc) and not again in each
// file that uses JSON, where they took a third of the time.
//
// The precompiled header (cmake/precompiled_library.h) gives these declarations to all files. A file
// without them compiles the templates itself.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace gsv::base::json_templates {

using nlohmann::json;
using nlohmann::ordered_json;
// The input of nlohmann::json::parse(): a std::string, or a std::string_view or literal.
using String = nlohmann::detail::iterator_input_adapter<std::string::const_iterator>;
using Characters = nlohmann::detail::iterator_input_adapter<const char*>;

}  // namespace gsv::base::json_templates

// Applies `instantiate` (`template` or `extern template`) to each of the templates.
#define GSV_JSON_TEMPLATES(instantiate)                               \
  instantiate class nlohmann::basic_json<>;                           \
  instantiate class nlohmann::basic_json<nlohmann::ordered_map>;      \
  GSV_JSON_TEMPLATES_OF(instantiate, gsv::base::json_templates::json) \
  GSV_JSON_TEMPLATES_OF(instantiate, gsv::base::json_templates::ordered_json)
#define GSV_JSON_TEMPLATES_OF(instantiate, Json)                                          \
  instantiate class nlohmann::detail::serializer<Json>;                                   \
  instantiate class nlohmann::detail::json_sax_dom_parser<Json>;                          \
  instantiate class nlohmann::detail::json_sax_dom_callback_parser<Json>;                 \
  instantiate class nlohmann::detail::lexer<Json, gsv::base::json_templates::String>;     \
  instantiate class nlohmann::detail::lexer<Json, gsv::base::json_templates::Characters>; \
  instantiate class nlohmann::detail::parser<Json, gsv::base::json_templates::String>;    \
  instantiate class nlohmann::detail::parser<Json, gsv::base::json_templates::Characters>;

GSV_JSON_TEMPLATES(extern template)
