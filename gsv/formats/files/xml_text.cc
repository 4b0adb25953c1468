#include "gsv/formats/files/xml_text.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

#include "gsv/formats/files/xml_entities.h"
#include "gsv/formats/files/xml_fault.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using base::Problem;

constexpr std::size_t kMaxEntityDepth = 32;
constexpr std::size_t kMaxExpansions = 1'000'000;
constexpr std::size_t kMaxNamedEntities = 20;

// Returns the length of the UTF-8 sequence at the beginning of `text`; 0 if there is none (RFC
// 3629).
std::size_t Utf8Length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const bool is_overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool is_beyond = (first == 0xED && byte(1) > 0x9F) || (first == 0xF4 && byte(1) > 0x8F);
  return is_overlong || is_beyond ? 0 : length;
}

// Returns the index of the first byte that is not valid UTF-8, or npos.
std::size_t FirstForeignByte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = Utf8Length(text.substr(i));
    if (length == 0) return i;
    i += length;
  }
  return std::string_view::npos;
}

// Converts ISO-8859-1 to UTF-8. In ISO-8859-1 each byte is a code point of Unicode.
std::string FromLatin1(std::string_view text) {
  std::string utf8;
  utf8.reserve(text.size() + text.size() / 8);
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      utf8 += c;
    } else {
      utf8 += static_cast<char>(0xC0 | (byte >> 6));
      utf8 += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return utf8;
}

bool DeclaresLatin1(std::string_view text) {
  constexpr std::size_t kMaxDeclarationLength = 200;
  std::string start(text.substr(0, std::min(text.find("?>"), kMaxDeclarationLength)));
  std::transform(start.begin(), start.end(), start.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return start.find("iso-8859-1") != std::string::npos || start.find("latin") != std::string::npos;
}

class XmlPreparation {
 public:
  XmlPreparation(std::string_view text, const std::string& file, std::size_t max_bytes,
                 base::Problems& problems)
      : file_(file), max_bytes_(max_bytes), problems_(problems), text_(text) {}

  base::Result<std::string> Prepare() {
    out_.reserve(text_.size());
    for (std::size_t at = 0; at < text_.size() && error_.empty();) at = TakeOne(at);
    if (error_.empty()) return std::move(out_);
    return Fail(ErrorCode::kBadModel, error_, PlaceAt(error_at_));
  }

 private:
  std::string PlaceAt(std::size_t at) const {
    return file_ + ":" +
           std::to_string(1 +
                          std::count(text_.begin(), text_.begin() + static_cast<long>(at), '\n'));
  }

  void Warn(std::string message, std::size_t at) {
    problems_.push_back({Problem::Severity::kWarning, std::move(message), PlaceAt(at)});
  }

  bool StartsAt(std::size_t at, std::string_view with) const {
    return text_.substr(at).starts_with(with);
  }

  // Returns the index after the next `end`, or npos if there is none. In the second case the
  // callers keep the rest of the text as it is, so that the parser reports the error.
  std::size_t After(std::size_t at, std::string_view end) const {
    const std::size_t found = text_.find(end, at);
    return found == std::string_view::npos ? std::string_view::npos : found + end.size();
  }

  // Processes markup, a reference or a character at `at`. Returns the index after the processed
  // text.
  std::size_t TakeOne(std::size_t at) {
    const char c = text_[at];
    if (c == '&') return TakeReference(at);
    if (quote_ != '\0') {
      if (c == quote_) quote_ = '\0';
    } else if (in_tag_) {
      if (c == '"' || c == '\'') quote_ = c;
      if (c == '>') in_tag_ = false;
    } else if (c == '<') {
      return TakeMarkup(at);
    }
    out_ += c;
    return at + 1;
  }

  std::size_t TakeMarkup(std::size_t at) {
    if (StartsAt(at, "<!--")) return Remove(at, After(at + 4, "-->"));
    if (StartsAt(at, "<![CDATA[")) return Keep(at, After(at + 9, "]]>"));
    if (StartsAt(at, "<!DOCTYPE")) return TakeDoctype(at);
    if (StartsAt(at, "<?")) return TakeInstruction(at);
    in_tag_ = true;
    out_ += '<';
    return at + 1;
  }

  // Leaves out the text from `at` to `end`, but not its newlines.
  std::size_t Remove(std::size_t at, std::size_t end) {
    if (end == std::string_view::npos) return KeepRest(at);
    out_.append(static_cast<std::size_t>(std::count(text_.begin() + static_cast<long>(at),
                                                    text_.begin() + static_cast<long>(end), '\n')),
                '\n');
    return end;
  }

  std::size_t Keep(std::size_t at, std::size_t end) {
    if (end == std::string_view::npos) return KeepRest(at);
    out_ += text_.substr(at, end - at);
    return end;
  }

  std::size_t KeepRest(std::size_t at) {
    out_ += text_.substr(at);
    return text_.size();
  }

  std::size_t TakeDoctype(std::size_t at) {
    doctype_ = ReadDoctype(text_, at);
    if (doctype_.end == std::string_view::npos) return KeepRest(at);
    if (doctype_.has_parameters) {
      Warn(
          "the parameter entities of <!DOCTYPE> are ignored: gsv expands only entities of the form "
          "&name;",
          at);
    }
    return Remove(at, doctype_.end);
  }

  // Removes a processing instruction. Keeps the declaration <?xml …?> if it is at the beginning of
  // the file. At any other place, parsers would refuse the file because of the declaration.
  std::size_t TakeInstruction(std::size_t at) {
    const std::size_t end = After(at, "?>");
    if (end == std::string_view::npos) return KeepRest(at);
    const bool is_declaration =
        StartsAt(at, "<?xml ") || StartsAt(at, "<?xml\t") || StartsAt(at, "<?xml?");
    const bool is_first = out_.find_first_not_of(" \t\r\n") == std::string::npos;
    if (is_declaration && is_first &&
        text_.substr(0, at).find_first_not_of(" \t\r\n") == std::string_view::npos) {
      out_ += text_.substr(at, end - at);
      return end;
    }
    if (is_declaration) Warn("<?xml …?> is preceded by other text; move it to the beginning", at);
    return Remove(at, end);
  }

  std::size_t TakeReference(std::size_t at) {
    const std::size_t length = EntityNameLength(text_.substr(at));
    const std::string_view name = text_.substr(at + 1, length);
    if (length == 0 || IsPredefinedEntity(name)) {
      out_ += '&';
      return at + 1;
    }
    place_ = at;
    Append(name);
    return at + length + 2;
  }

  // Appends the value of the entity, and expands the entities in it.
  void Append(std::string_view name) {
    const auto entity = doctype_.entities.find(name);
    if (entity == doctype_.entities.end()) {
      NameOnce(name,
               "is not declared; it is left as it is. Declare it in <!DOCTYPE>, or write &amp; for "
               "\"&\"");
      out_ += "&" + std::string(name) + ";";
    } else if (entity->second.is_external) {
      NameOnce(name, "is in another file, which gsv does not read; it is left out");
    } else if (std::find(open_.begin(), open_.end(), name) != open_.end()) {
      Refuse("the entity &" + std::string(name) + "; contains itself");
    } else if (open_.size() == kMaxEntityDepth) {
      Refuse("the entities are nested deeper than " + std::to_string(kMaxEntityDepth) + " levels");
    } else if (++expansions_ > kMaxExpansions) {
      Refuse("the file needs more than " + std::to_string(kMaxExpansions) +
             " expansions of entities");
    } else {
      open_.push_back(name);
      AppendValue(entity->second.value);
      open_.pop_back();
    }
  }

  void AppendValue(std::string_view value) {
    for (std::size_t i = 0; i < value.size() && error_.empty(); ++i) {
      const std::size_t length = value[i] == '&' ? EntityNameLength(value.substr(i)) : 0;
      if (length > 0 && !IsPredefinedEntity(value.substr(i + 1, length))) {
        Append(value.substr(i + 1, length));
        i += length + 1;
      } else {
        AppendCharacter(value[i]);
      }
    }
    if (out_.size() > max_bytes_) {
      Refuse("the entities of the file expand to more than the limit of " +
             std::to_string(max_bytes_) + " bytes");
    }
  }

  // Appends a character of an entity's value. In an attribute, quotes and tags are text, so they
  // are escaped (XML 1.0, section 4.4.5). Newlines become spaces, because they would shift the
  // later lines.
  void AppendCharacter(char c) {
    if (c == '\n' || c == '\r') {
      out_ += ' ';
    } else if (quote_ != '\0' && c == '<') {
      out_ += "&lt;";
    } else if (quote_ != '\0' && c == quote_) {
      out_ += c == '"' ? "&quot;" : "&apos;";
    } else {
      out_ += c;
    }
  }

  void NameOnce(std::string_view name, const char* what) {
    if (named_.size() < kMaxNamedEntities && named_.insert(std::string(name)).second) {
      Warn("the entity &" + std::string(name) + "; " + what, place_);
    }
  }

  void Refuse(std::string message) {
    if (!error_.empty()) return;
    error_ = std::move(message);
    error_at_ = place_;
  }

  const std::string& file_;
  const std::size_t max_bytes_;
  base::Problems& problems_;
  const std::string_view text_;
  std::string out_;
  bool in_tag_ = false;
  char quote_ = '\0';  // the quotation mark of the current attribute; '\0' outside of attributes
  XmlDoctype doctype_;
  std::vector<std::string_view> open_;  // the entities that are being expanded
  std::set<std::string> named_;         // the entities that have a warning
  std::size_t expansions_ = 0, place_ = 0, error_at_ = 0;
  std::string error_;
};

}  // namespace

base::Result<std::string> PrepareXml(const std::string& text, const std::string& file,
                                     std::size_t max_bytes, base::Problems& problems) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string_view content = text;
  if (content.starts_with(kByteOrderMark)) content.remove_prefix(kByteOrderMark.size());
  if (content.starts_with("\xff\xfe") || content.starts_with("\xfe\xff")) return text;  // UTF-16
  const std::size_t foreign = FirstForeignByte(content);
  if (foreign == std::string_view::npos)
    return XmlPreparation(content, file, max_bytes, problems).Prepare();
  if (!DeclaresLatin1(content)) {
    const auto line =
        1 + std::count(content.begin(), content.begin() + static_cast<long>(foreign), '\n');
    problems.push_back(
        {Problem::Severity::kWarning,
         "the text is not UTF-8; it is read as ISO-8859-1. Convert it with iconv -t UTF-8",
         file + ":" + std::to_string(line)});
  }
  return XmlPreparation(FromLatin1(content), file, max_bytes, problems).Prepare();
}

base::Status ParseXml(const std::string& text, const std::string& file, std::size_t max_bytes,
                      tinyxml2::XMLDocument& document, base::Problems& problems) {
  const auto prepared = PrepareXml(text, file, max_bytes, problems);
  if (!prepared) return Fail(prepared.error());
  if (document.Parse(prepared->data(), prepared->size()) != tinyxml2::XML_SUCCESS) {
    const auto error = DescribeXmlError(text, file, document.ErrorLineNum());
    return Fail(ErrorCode::kBadModel, error.message, error.place);
  }
  const tinyxml2::XMLElement* root = document.RootElement();
  if (const auto* second = root == nullptr ? nullptr : root->NextSiblingElement()) {
    problems.push_back({Problem::Severity::kWarning,
                        "a second root element, <" + std::string(second->Name()) +
                            ">, is ignored; an XML file has only one",
                        file + ":" + std::to_string(second->GetLineNum())});
  }
  return {};
}

}  // namespace gsv::formats
