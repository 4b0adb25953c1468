#include "gsv/formats/xacro/expression_parser.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace gsv::formats::xacro {
namespace {

using Kind = Expression::Kind;
using ParsedPtr = std::unique_ptr<Expression>;

constexpr int kMaxExpressionDepth = 64;
constexpr std::size_t kMaxTokens = 4096;
constexpr const char* kTooDeep = "the expression is nested deeper than 64 levels";

struct Token {
  enum class Kind { kEnd, kName, kNumber, kString, kSymbol };
  Kind kind = Kind::kEnd;
  std::string text;  // content of a string
};

bool IsNameStart(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool IsNamePart(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

class Lexer {
 public:
  explicit Lexer(const std::string& text) : text_(text) {}

  base::Result<std::vector<Token>> Read() {
    std::vector<Token> tokens;
    for (;;) {
      while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
      auto token = Next();
      if (!token) return base::Fail(token.error());
      tokens.push_back(*std::move(token));
      if (tokens.back().kind == Token::Kind::kEnd) return tokens;
      if (tokens.size() > kMaxTokens)
        return Refuse("the expression has more than " + std::to_string(kMaxTokens) +
                      " names, numbers and signs");
    }
  }

 private:
  static base::Failure<base::Error> Refuse(const std::string& why) {
    return base::Fail(base::ErrorCode::kBadModel, why);
  }

  base::Result<Token> Next() {
    if (at_ >= text_.size()) return Token{};
    const char c = text_[at_];
    if (IsNameStart(c)) {
      const std::size_t first = at_;
      while (at_ < text_.size() && IsNamePart(text_[at_])) ++at_;
      if (at_ < text_.size() && (text_[at_] == '\'' || text_[at_] == '"')) {
        return Refuse("strings with a prefix, such as f'…', are not supported");
      }
      return Token{Token::Kind::kName, text_.substr(first, at_ - first)};
    }
    if (IsDigit(c) || (c == '.' && at_ + 1 < text_.size() && IsDigit(text_[at_ + 1]))) {
      return Number();
    }
    if (c == '\'' || c == '"') return String(c);
    return Symbol();
  }

  Token Number() {
    const std::size_t first = at_;
    const auto digits = [&] {
      while (at_ < text_.size() && (IsDigit(text_[at_]) || text_[at_] == '_')) ++at_;
    };
    digits();
    if (at_ < text_.size() && text_[at_] == '.') {
      ++at_;
      digits();
    }
    if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
      std::size_t after = at_ + 1;
      if (after < text_.size() && (text_[after] == '+' || text_[after] == '-')) ++after;
      if (after < text_.size() && IsDigit(text_[after])) {
        at_ = after;
        digits();
      }
    }
    std::string number = text_.substr(first, at_ - first);
    std::erase(number, '_');
    return {Token::Kind::kNumber, number};
  }

  base::Result<Token> String(char quote) {
    Token token{Token::Kind::kString, ""};
    for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) {
        const char next = text_[++at_];
        if (next == 'n') {
          token.text += '\n';
        } else if (next == 't') {
          token.text += '\t';
        } else {
          if (next != '\\' && next != '\'' && next != '"') token.text += '\\';
          token.text += next;
        }
      } else {
        token.text += text_[at_];
      }
    }
    if (at_ >= text_.size()) return Refuse("a string does not end");
    ++at_;
    return token;
  }

  base::Result<Token> Symbol() {
    constexpr std::array<std::string_view, 25> kSymbols{
        "**", "//", "==", "!=", "<=", ">=", "<", ">", "+", "-", "*", "/", "%",
        "(",  ")",  "[",  "]",  "{",  "}",  ",", ":", ".", "=", "@", "~"};
    for (const std::string_view symbol : kSymbols) {
      if (std::string_view(text_).substr(at_, symbol.size()) != symbol) continue;
      at_ += symbol.size();
      return Token{Token::Kind::kSymbol, std::string(symbol)};
    }
    return Refuse(std::string("\"") + text_[at_] + "\" is not supported in an expression");
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

class Parser {
 public:
  explicit Parser(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

  base::Result<ParsedPtr> Read() {
    ParsedPtr node = TernaryOrTuple();
    if (error_.empty() && Now().kind != Token::Kind::kEnd) {
      Refuse("\"" + Now().text + "\" is not expected here");
    }
    if (!error_.empty()) return base::Fail(base::ErrorCode::kBadModel, error_);
    return node;
  }

 private:
  // Stores the error. After it, all results are null, and nothing more is read.
  ParsedPtr Refuse(const std::string& why) {
    if (error_.empty()) error_ = why;
    at_ = tokens_.size() - 1;
    return nullptr;
  }
  const Token& Now() const { return tokens_[at_]; }
  bool Is(const char* text) const {
    return (Now().kind == Token::Kind::kSymbol || Now().kind == Token::Kind::kName) &&
           Now().text == text;
  }
  bool Take(const char* text) {
    if (!Is(text)) return false;
    ++at_;
    return true;
  }
  void Expect(const char* text) {
    if (!Take(text)) Refuse(std::string("\"") + text + "\" is missing");
  }

  static ParsedPtr Make(Kind kind, std::string text = {}) {
    auto node = std::make_unique<Expression>();
    node->kind = kind;
    node->text = std::move(text);
    return node;
  }
  static ParsedPtr Pair(Kind kind, const std::string& text, ParsedPtr a, ParsedPtr b) {
    ParsedPtr node = Make(kind, text);
    node->parts.push_back(std::move(a));
    node->parts.push_back(std::move(b));
    return node;
  }

  ParsedPtr TernaryOrTuple() {
    ParsedPtr first = Ternary();
    if (!Is(",")) return first;
    ParsedPtr tuple = Make(Kind::kTuple);
    tuple->parts.push_back(std::move(first));
    while (Take(",")) {
      if (Is(")") || Now().kind == Token::Kind::kEnd) break;
      tuple->parts.push_back(Ternary());
    }
    return tuple;
  }

  ParsedPtr Ternary() {
    if (++depth_ > kMaxExpressionDepth) return Refuse(kTooDeep);
    if (Is("lambda")) return Refuse("lambda is not supported in an expression");
    ParsedPtr then = Or();
    if (Take("if")) {
      ParsedPtr node = Make(Kind::kTernary);
      node->parts.push_back(Or());
      Expect("else");
      node->parts.push_back(std::move(then));
      node->parts.push_back(Ternary());
      then = std::move(node);
    }
    if (Is("for")) Refuse("comprehensions are not supported in an expression");
    --depth_;
    return then;
  }

  ParsedPtr Or() {
    ParsedPtr left = And();
    while (Take("or")) left = Pair(Kind::kOr, "or", std::move(left), And());
    return left;
  }

  ParsedPtr And() {
    ParsedPtr left = Not();
    while (Take("and")) left = Pair(Kind::kAnd, "and", std::move(left), Not());
    return left;
  }

  ParsedPtr Not() {
    if (!Take("not")) return Comparison();
    return Unary("not", &Parser::Not);
  }

  ParsedPtr Unary(const char* sign, ParsedPtr (Parser::*operand)()) {
    if (++depth_ > kMaxExpressionDepth) return Refuse(kTooDeep);
    ParsedPtr node = Make(Kind::kUnary, sign);
    node->parts.push_back((this->*operand)());
    --depth_;
    return node;
  }

  std::string Comparator() {
    for (const char* text : {"==", "!=", "<=", ">=", "<", ">", "in"}) {
      if (Take(text)) return text;
    }
    if (Take("not")) {
      Expect("in");
      return "not in";
    }
    if (Take("is")) return Take("not") ? "!=" : "==";
    return "";
  }

  ParsedPtr Comparison() {
    ParsedPtr first = Sum();
    ParsedPtr compare;
    for (std::string word = Comparator(); !word.empty(); word = Comparator()) {
      if (compare == nullptr) {
        compare = Make(Kind::kCompare);
        compare->parts.push_back(std::move(first));
      }
      compare->words.push_back(word);
      compare->parts.push_back(Sum());
    }
    return compare == nullptr ? std::move(first) : std::move(compare);
  }

  ParsedPtr Sum() {
    ParsedPtr left = Product();
    while (Is("+") || Is("-")) {
      const std::string sign = tokens_[at_++].text;
      left = Pair(Kind::kBinary, sign, std::move(left), Product());
    }
    return left;
  }

  ParsedPtr Product() {
    ParsedPtr left = Signed();
    while (Is("*") || Is("/") || Is("//") || Is("%")) {
      const std::string sign = tokens_[at_++].text;
      left = Pair(Kind::kBinary, sign, std::move(left), Signed());
    }
    return left;
  }

  ParsedPtr Signed() {
    if (Take("-")) return Unary("-", &Parser::Signed);
    if (Take("+")) return Unary("+", &Parser::Signed);
    ParsedPtr base = Postfix();
    if (!Take("**")) return base;
    if (++depth_ > kMaxExpressionDepth) return Refuse(kTooDeep);
    base = Pair(Kind::kBinary, "**", std::move(base), Signed());
    --depth_;
    return base;
  }

  ParsedPtr Postfix() {
    ParsedPtr node = Atom();
    for (int links = 0;; ++links) {
      if (links > kMaxExpressionDepth) return Refuse(kTooDeep);
      if (Take(".")) {
        if (Now().kind != Token::Kind::kName) return Refuse("a name is missing after \".\"");
        ParsedPtr member = Make(Kind::kMember, tokens_[at_++].text);
        member->parts.push_back(std::move(node));
        node = std::move(member);
      } else if (Take("(")) {
        node = Call(std::move(node));
      } else if (Take("[")) {
        node = Subscript(std::move(node));
      } else {
        return node;
      }
    }
  }

  ParsedPtr Call(ParsedPtr function) {
    ParsedPtr call = Make(Kind::kCall);
    call->parts.push_back(std::move(function));
    while (!Is(")") && error_.empty()) {
      if (Is("*") || Is("**")) return Refuse("* and ** are not supported in a call");
      const bool is_keyword = Now().kind == Token::Kind::kName && tokens_[at_ + 1].text == "=" &&
                              tokens_[at_ + 1].kind == Token::Kind::kSymbol;
      if (is_keyword) {
        call->words.push_back(Now().text);
        at_ += 2;
      } else if (!call->words.empty()) {
        return Refuse("an argument without a name follows an argument with a name");
      }
      call->parts.push_back(Ternary());
      if (!Take(",")) break;
    }
    Expect(")");
    return call;
  }

  ParsedPtr Subscript(ParsedPtr of) {
    ParsedPtr node = Make(Kind::kIndex);
    node->parts.push_back(std::move(of));
    node->parts.push_back(Is(":") ? nullptr : Ternary());
    if (Take(":")) {
      node->kind = Kind::kSlice;
      node->parts.push_back(Is("]") ? nullptr : Ternary());
    }
    Expect("]");
    return node;
  }

  ParsedPtr Atom() {
    const Token token = Now();
    switch (token.kind) {
      case Token::Kind::kEnd:
        return Refuse("the expression ends too early");
      case Token::Kind::kNumber:
        ++at_;
        return Number(token.text);
      case Token::Kind::kString: {
        ParsedPtr node = Make(Kind::kLiteral);
        std::string text;
        while (Now().kind == Token::Kind::kString) text += tokens_[at_++].text;
        node->value = {text};
        return node;
      }
      case Token::Kind::kName:
        ++at_;
        return Name(token.text);
      case Token::Kind::kSymbol:
        break;
    }
    if (Take("(")) return Parenthesis();
    if (Take("[")) return ListDisplay();
    if (Take("{")) return DictionaryDisplay();
    return Refuse("\"" + token.text + "\" is not expected here");
  }

  ParsedPtr Number(const std::string& text) {
    ParsedPtr node = Make(Kind::kLiteral);
    if (const auto integer = ParseInteger(text)) {
      node->value = {*integer};
    } else if (const auto real = ParseFloat(text)) {
      node->value = {*real};
    } else {
      return Refuse("\"" + text + "\" is not a number");
    }
    return node;
  }

  ParsedPtr Name(const std::string& text) {
    for (const char* word : {"if", "else", "for", "and", "or", "in", "is", "import", "lambda"}) {
      if (text == word) return Refuse("\"" + text + "\" is not expected here");
    }
    ParsedPtr node = Make(Kind::kLiteral);
    if (text == "True" || text == "False") {
      node->value = {text == "True"};
    } else if (text != "None") {
      node = Make(Kind::kName, text);
    }
    return node;
  }

  ParsedPtr Parenthesis() {
    if (Take(")")) return Make(Kind::kTuple);
    ParsedPtr inner = TernaryOrTuple();
    Expect(")");
    return inner;
  }

  ParsedPtr ListDisplay() {
    ParsedPtr list = Make(Kind::kList);
    while (!Is("]") && error_.empty()) {
      list->parts.push_back(Ternary());
      if (!Take(",")) break;
    }
    Expect("]");
    return list;
  }

  ParsedPtr DictionaryDisplay() {
    ParsedPtr dictionary = Make(Kind::kDictionary);
    while (!Is("}") && error_.empty()) {
      dictionary->parts.push_back(Ternary());
      Expect(":");
      dictionary->parts.push_back(Ternary());
      if (!Take(",")) break;
    }
    Expect("}");
    return dictionary;
  }

  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::string error_;
};

}  // namespace

base::Result<std::unique_ptr<Expression>> ParseExpression(const std::string& text) {
  auto tokens = Lexer(text).Read();
  if (!tokens) return base::Fail(tokens.error());
  return Parser(*std::move(tokens)).Read();
}

}  // namespace gsv::formats::xacro
