#include "gsv/formats/files/xml_entities.h"

#include <algorithm>
#include <cctype>

namespace gsv::formats {
namespace {

constexpr std::size_t kMaxEntityNameLength = 256;

bool IsNameCharacter(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return std::isalnum(byte) != 0 || byte >= 0x80 || c == '_' || c == '-' || c == '.' || c == ':';
}

bool IsXmlSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

class DoctypeReader {
 public:
  DoctypeReader(std::string_view text, std::size_t begin) : text_(text), at_(begin) {}

  XmlDoctype Read() {
    at_ += std::string_view("<!DOCTYPE").size();
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '>' && !in_subset_) {
        doctype_.end = at_ + 1;
        return std::move(doctype_);
      }
      TakeOne(c);
    }
    doctype_.end = std::string_view::npos;
    return std::move(doctype_);
  }

 private:
  void TakeOne(char c) {
    if (c == '"' || c == '\'') {
      TakeQuoted();
    } else if (Starts("<!--")) {
      SkipPast("-->");
    } else if (Starts("<?")) {
      SkipPast("?>");
    } else if (in_subset_ && Starts("<!ENTITY")) {
      TakeEntity();
    } else {
      if (c == '[') in_subset_ = true;
      if (c == ']') in_subset_ = false;
      if (c == '%' && in_subset_) doctype_.has_parameters = true;
      ++at_;
    }
  }

  bool Starts(std::string_view with) const { return text_.substr(at_).starts_with(with); }

  void SkipPast(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    at_ = found == std::string_view::npos ? text_.size() : found + end.size();
  }

  void SkipSpace() {
    while (at_ < text_.size() && IsXmlSpace(text_[at_])) ++at_;
  }

  std::string_view TakeWord() {
    SkipSpace();
    const std::size_t begin = at_;
    while (at_ < text_.size() && IsNameCharacter(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  std::string_view TakeQuoted() {
    const std::size_t begin = at_ + 1;
    const std::size_t end = text_.find(text_[at_], begin);
    at_ = end == std::string_view::npos ? text_.size() : end + 1;
    return text_.substr(begin, (end == std::string_view::npos ? text_.size() : end) - begin);
  }

  // Reads a declaration: <!ENTITY name "value"> or <!ENTITY name SYSTEM "file">. A % before the
  // name declares a parameter entity.
  void TakeEntity() {
    at_ += std::string_view("<!ENTITY").size();
    SkipSpace();
    const bool is_parameter = at_ < text_.size() && text_[at_] == '%';
    if (is_parameter) {
      doctype_.has_parameters = true;
      ++at_;
    }
    const std::string name(TakeWord());
    XmlEntity entity;
    entity.is_external = !TakeWord().empty();
    while (at_ < text_.size() && text_[at_] != '>') {
      if (text_[at_] == '"' || text_[at_] == '\'') {
        const std::string_view value = TakeQuoted();
        if (!entity.is_external) entity.value = std::string(value);
      } else {
        ++at_;
      }
    }
    if (at_ < text_.size()) ++at_;
    if (!is_parameter && !name.empty()) doctype_.entities.emplace(name, std::move(entity));
  }

  const std::string_view text_;
  std::size_t at_;
  bool in_subset_ = false;
  XmlDoctype doctype_;
};

}  // namespace

XmlDoctype ReadDoctype(std::string_view text, std::size_t begin) {
  return DoctypeReader(text, begin).Read();
}

bool IsPredefinedEntity(std::string_view name) {
  static constexpr std::string_view kNames[] = {"amp", "lt", "gt", "quot", "apos"};
  return name.starts_with('#') ||
         std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

std::size_t EntityNameLength(std::string_view text) {
  std::size_t end = 1;
  if (end < text.size() && text[end] == '#') ++end;
  while (end < text.size() && end <= kMaxEntityNameLength && IsNameCharacter(text[end])) ++end;
  return end < text.size() && text[end] == ';' ? end - 1 : 0;
}

}  // namespace gsv::formats
