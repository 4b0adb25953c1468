// Declares the large templates of the JSON library, so that they are compiled only once, in
// json_templates.cc. Without these declarations, each file that uses JSON compiles the templates
// itself, which takes a third of its compile time.
//
// All files get these declarations from the precompiled header (cmake/precompiled_library.h).
#pragma once

#include <string>

// <nlohmann/json.hpp> defines the operator _json as an inline function. GCC therefore instantiates the
// whole parser in each file that includes the header, even if nothing uses it, and even if the
// templates below are declared as extern. So the operator is only declared, and its body
// becomes that of a template that nothing uses. Call nlohmann::json::parse() instead of the operator.
#ifndef INCLUDE_NLOHMANN_JSON_HPP_
#define _json(...)                           \
  _json(const char* text, std::size_t size); \
  template <typename Unused>                 \
  nlohmann::json BodyOfJsonOperator(__VA_ARGS__)
#include <nlohmann/json.hpp>
#undef _json
#endif

namespace gsv::base::json_templates {

using nlohmann::json;
using nlohmann::ordered_json;
// The input of nlohmann::json::parse() is a String for a std::string, and Characters for a
// std::string_view or a literal.
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
