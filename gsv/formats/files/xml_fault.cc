#include "gsv/formats/files/xml_fault.h"

#include <algorithm>
#include <vector>

#include "gsv/formats/files/xml_entities.h"

namespace gsv::formats {
namespace {

constexpr std::size_t kMaxTagNameLength = 60;
constexpr std::string_view kXmlBlanks = " \t\r\n";

class FaultFinder {
 public:
  explicit FaultFinder(std::string_view text) : text_(text) {}

  std::optional<XmlFault> Find() {
    while (!fault_ && at_ < text_.size()) {
      const std::size_t tag = text_.find('<', at_);
      const bool is_in_element = !open_.empty();
      if (!is_in_element) CheckOutside(text_.substr(at_, tag - at_));
      if (fault_ || tag == std::string_view::npos) break;
      at_ = tag;
      TakeMarkup();
    }
    if (!fault_ && !open_.empty()) {
      const Open& last = open_.back();
      FaultAt(last.at, Tag(last.name) + " is not closed. Add </" + Shortened(last.name) + ">");
    }
    if (!fault_ && !has_root_) FaultAt(0, "the file contains no element. Is this the right file?");
    return fault_;
  }

 private:
  struct Open {
    std::string_view name;
    std::size_t at;
  };

  static std::string Shortened(std::string_view name) {
    return std::string(name.substr(0, kMaxTagNameLength));
  }
  static std::string Tag(std::string_view name) { return "<" + Shortened(name) + ">"; }

  void FaultAt(std::size_t at, std::string sentence) {
    const std::string_view before = text_.substr(0, at);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t newline = before.rfind('\n');
    const std::size_t column = newline == std::string_view::npos ? at + 1 : at - newline;
    fault_ = XmlFault{static_cast<int>(line), static_cast<int>(column), std::move(sentence)};
  }

  // Reports an error if `between`, which is outside of the root element, has anything but blanks.
  void CheckOutside(std::string_view between) {
    const std::size_t found = between.find_first_not_of(kXmlBlanks);
    if (found == std::string_view::npos || (!has_root_ && at_ == 0)) return;
    FaultAt(at_ + found, "there is text outside of the root element. Remove it");
  }

  bool Starts(std::string_view with) const { return text_.substr(at_).starts_with(with); }

  void TakeMarkup() {
    if (Starts("<!--")) {
      SkipTo("-->", "the comment");
    } else if (Starts("<![CDATA[")) {
      SkipTo("]]>", "the CDATA section");
    } else if (Starts("<?")) {
      SkipTo("?>", "the declaration");
    } else if (Starts("<!DOCTYPE")) {
      const std::size_t end = ReadDoctype(text_, at_).end;
      if (end == std::string_view::npos) FaultAt(at_, "<!DOCTYPE does not end. Add >");
      at_ = std::min(end, text_.size());
    } else if (Starts("<!")) {
      SkipTo(">", "the declaration");
    } else if (Starts("</")) {
      TakeEnd();
    } else {
      TakeStart();
    }
  }

  void SkipTo(std::string_view end, const std::string& what) {
    const std::size_t found = text_.find(end, at_ + 2);
    if (found == std::string_view::npos) {
      FaultAt(at_, what + " does not end. Add " + std::string(end));
    } else {
      at_ = found + end.size();
    }
  }

  std::string_view TakeName() {
    const std::size_t begin = at_;
    at_ = std::min(text_.find_first_of(" \t\r\n/><=\"'", at_), text_.size());
    return text_.substr(begin, at_ - begin);
  }

  void SkipBlanks() { at_ = std::min(text_.find_first_not_of(kXmlBlanks, at_), text_.size()); }

  void TakeEnd() {
    const std::size_t begin = at_;
    at_ += 2;
    const std::string_view name = TakeName();
    SkipBlanks();
    if (at_ >= text_.size() || text_[at_] != '>') {
      FaultAt(begin, "the tag </" + Shortened(name) + " does not end. Add >");
    } else if (open_.empty()) {
      FaultAt(begin, "</" + Shortened(name) + "> has no opening tag. Remove it");
    } else if (open_.back().name != name) {
      FaultAt(begin, "expected </" + Shortened(open_.back().name) + ">, found </" +
                         Shortened(name) + ">. Close " + Tag(open_.back().name) + " of line " +
                         std::to_string(LineOf(open_.back().at)) + " first");
    } else {
      open_.pop_back();
      ++at_;
    }
  }

  long LineOf(std::size_t at) const {
    const std::string_view before = text_.substr(0, at);
    return std::count(before.begin(), before.end(), '\n') + 1;
  }

  void TakeStart() {
    const std::size_t begin = at_;
    ++at_;
    const std::string_view name = TakeName();
    if (name.empty()) {
      FaultAt(begin, "\"<\" does not start a tag. In text, write &lt;");
      return;
    }
    has_root_ = true;
    while (!fault_) {
      SkipBlanks();
      if (at_ >= text_.size() || text_[at_] == '<') {
        FaultAt(begin, "the tag <" + Shortened(name) + " does not end. Add >");
      } else if (text_[at_] == '>') {
        open_.push_back({name, begin});
        ++at_;
        return;
      } else if (Starts("/>")) {
        at_ += 2;
        return;
      } else {
        TakeAttribute(name);
      }
    }
  }

  void TakeAttribute(std::string_view element) {
    const std::size_t begin = at_;
    const std::string_view name = TakeName();
    SkipBlanks();
    if (name.empty() || at_ >= text_.size() || text_[at_] != '=') {
      FaultAt(begin, "an attribute of " + Tag(element) + " is malformed. Write name=\"value\"");
      return;
    }
    ++at_;
    SkipBlanks();
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    const std::size_t end =
        quote == '"' || quote == '\'' ? text_.find(quote, at_ + 1) : std::string_view::npos;
    if (end == std::string_view::npos) {
      FaultAt(begin, "the attribute " + Shortened(name) + " of " + Tag(element) +
                         " needs a value in quotes. Write " + Shortened(name) + "=\"value\"");
      return;
    }
    at_ = end + 1;
  }

  const std::string_view text_;
  std::size_t at_ = 0;
  std::vector<Open> open_;
  bool has_root_ = false;
  std::optional<XmlFault> fault_;
};

}  // namespace

std::optional<XmlFault> FindXmlFault(std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    return XmlFault{
        1, 1,
        "the text is in UTF-16, and only UTF-8 is read. Convert it with iconv -f UTF-16 "
        "-t UTF-8, and delete its encoding=\"UTF-16\""};
  }
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
    const auto line = std::count(text.begin(), text.begin() + static_cast<long>(zero), '\n') + 1;
    return XmlFault{static_cast<int>(line), 1,
                    "the line contains a zero byte, so this is not a text file. Remove the byte"};
  }
  return FaultFinder(text).Find();
}

XmlErrorText DescribeXmlError(std::string_view text, const std::string& file, int line) {
  if (const auto fault = FindXmlFault(text)) {
    return {file + ":" + std::to_string(fault->line) + ":" + std::to_string(fault->column),
            "the XML is malformed: " + fault->sentence};
  }
  return {file + ":" + std::to_string(line),
          "the XML is malformed near this line. Check it with xmllint --noout"};
}

}  // namespace gsv::formats
