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

// Applies `instantiate` (`template` or `extern template`) to each of the templates. Of basic_json, only
// the members that are large and used are listed: the whole class also has the binary formats, patches
// and differences, and takes two and a half times as long.
#define GSV_JSON_TEMPLATES(instantiate)                               \
  GSV_JSON_TEMPLATES_OF(instantiate, gsv::base::json_templates::json) \
  GSV_JSON_TEMPLATES_OF(instantiate, gsv::base::json_templates::ordered_json)
#define GSV_JSON_TEMPLATES_OF(instantiate, Json)                                                \
  instantiate Json::json_value::json_value(Json::value_t);                                      \
  instantiate void Json::json_value::destroy(Json::value_t);                                    \
  instantiate Json::basic_json(const Json&);                                                    \
  instantiate Json::basic_json(Json::initializer_list_t, bool, Json::value_t);                  \
  instantiate Json::~basic_json();                                                              \
  instantiate void Json::push_back(Json&&);                                                     \
  instantiate void Json::push_back(Json::initializer_list_t);                                   \
  instantiate void Json::update(Json::const_iterator, Json::const_iterator, bool);              \
  instantiate Json& Json::operator[](std::string);                                              \
  instantiate const Json& Json::operator[](const std::string&) const;                           \
  instantiate const Json& Json::operator[](std::size_t) const;                                  \
  instantiate bool Json::operator==(const Json&) const noexcept;                                \
  instantiate std::string Json::dump(int, char, bool, nlohmann::detail::error_handler_t) const; \
  instantiate class nlohmann::detail::serializer<Json>;                                         \
  instantiate class nlohmann::detail::json_sax_dom_parser<Json>;                                \
  instantiate class nlohmann::detail::json_sax_dom_callback_parser<Json>;                       \
  instantiate class nlohmann::detail::lexer<Json, gsv::base::json_templates::String>;           \
  instantiate class nlohmann::detail::lexer<Json, gsv::base::json_templates::Characters>;       \
  instantiate class nlohmann::detail::parser<Json, gsv::base::json_templates::String>;          \
  instantiate class nlohmann::detail::parser<Json, gsv::base::json_templates::Characters>;

GSV_JSON_TEMPLATES(extern template)
