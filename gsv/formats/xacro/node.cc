#include "gsv/formats/xacro/node.h"

#include <algorithm>

namespace gsv::formats::xacro {
namespace {

void AppendEscaped(const std::string& text, std::string& xml) {
  for (const char c : text) {
    switch (c) {
      case '&':
        xml += "&amp;";
        break;
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      case '"':
        xml += "&quot;";
        break;
      // A newline in a text would shift later lines, so it becomes a space. For the readers of this
      // XML all blanks are equal.
      case '\n':
      case '\r':
        xml += ' ';
        break;
      default:
        xml += c;
    }
  }
}

void AppendXml(const Node& node, std::size_t max_bytes, int& line, Expansion& expansion) {
  std::string& xml = expansion.xml;
  if (xml.size() > max_bytes) return;
  if (!node.is_element) {
    AppendEscaped(node.text, xml);
    return;
  }
  expansion.sources.push_back({node.file, node.line});
  for (; line < node.call_line; ++line) xml += '\n';
  xml += "<" + node.text;
  for (const auto& [name, value] : node.attributes) {
    xml += " " + name + "=\"";
    AppendEscaped(value, xml);
    xml += '"';
  }
  xml += '>';
  for (const NodePtr& child : node.children) AppendXml(*child, max_bytes, line, expansion);
  xml += "</" + node.text + ">";
}

}  // namespace

const std::string* Node::attribute(const std::string& name) const {
  const auto it = std::find_if(attributes.begin(), attributes.end(),
                               [&](const auto& each) { return each.first == name; });
  return it == attributes.end() ? nullptr : &it->second;
}

std::string Node::place() const { return file->string() + ":" + std::to_string(line); }

NodePtr ToNode(const tinyxml2::XMLElement& element,
               const std::shared_ptr<const std::filesystem::path>& file) {
  auto node = std::make_shared<Node>();
  node->text = element.Name();
  node->file = file;
  node->line = node->call_line = element.GetLineNum();
  for (auto* attribute = element.FirstAttribute(); attribute != nullptr;
       attribute = attribute->Next()) {
    node->attributes.emplace_back(attribute->Name(), attribute->Value());
  }
  for (auto* child = element.FirstChild(); child != nullptr; child = child->NextSibling()) {
    if (auto* inner = child->ToElement()) {
      node->children.push_back(ToNode(*inner, file));
    } else if (auto* text = child->ToText()) {
      const std::string content = text->Value();
      if (content.find_first_not_of(" \t\r\n") == std::string::npos) continue;
      auto leaf = std::make_shared<Node>();
      leaf->is_element = false;
      leaf->text = content;
      leaf->file = file;
      leaf->line = leaf->call_line = text->GetLineNum();
      node->children.push_back(std::move(leaf));
    }
  }
  return node;
}

Expansion ToXml(const Node& node, std::size_t max_bytes) {
  Expansion expansion{"<?xml version='1.0'?>", {}};
  int line = 1;
  AppendXml(node, max_bytes, line, expansion);
  return expansion;
}

}  // namespace gsv::formats::xacro
