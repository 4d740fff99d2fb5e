#include "runner/store/expression.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <utility>

namespace seapile::store {

namespace {

constexpr int kDeepest = 100;  // brackets and negations within each other

/// A bracket, a word of the grammar, or a condition's text.
struct Token {
  enum class Kind { open, close, conjunction, disjunction, negation, condition, end };
  Kind kind;
  std::string text;
};
using Kind = Token::Kind;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n'; }

/// Where the quoted text that begins at `at` has ended; one that is left open ends with the text.
std::size_t behind_quotes(const std::string& text, std::size_t at) {
  const std::size_t end = text.find(text[at], at + 1);
  return end == text.npos ? text.size() : end + 1;
}

bool is_quote(char c) { return c == '"' || c == '\''; }

Kind kind_of(std::string word) {
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word == "and"   ? Kind::conjunction
         : word == "or"  ? Kind::disjunction
         : word == "not" ? Kind::negation
                         : Kind::condition;
}

/// What is neither a bracket nor a word of the grammar, with the blanks in between, is one condition.
std::vector<Token> tokens(const std::string& text) {
  std::vector<Token> all;
  std::size_t at = 0;
  while (at < text.size()) {
    std::size_t end = at + 1;
    Kind kind = Kind::condition;
    if (is_blank(text[at])) {
      at = end;
      continue;
    }
    if (text[at] == '(' || text[at] == ')') {
      kind = text[at] == '(' ? Kind::open : Kind::close;
    } else {
      for (end = at; end < text.size() && !is_blank(text[end]) && text[end] != '(' && text[end] != ')';) {
        end = is_quote(text[end]) ? behind_quotes(text, end) : end + 1;
      }
      kind = kind_of(text.substr(at, end - at));
    }
    const std::string piece = text.substr(at, end - at);
    if (kind == Kind::condition && !all.empty() && all.back().kind == Kind::condition) {
      all.back().text += ' ' + piece;
    } else {
      all.push_back({kind, piece});
    }
    at = end;
  }
  all.push_back({Kind::end, "the end"});
  return all;
}

class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text), tokens_(tokens(text)) {}

  Expression whole() {
    Expression expression = any();
    if (next().kind == Kind::close) refuse("a bracket is closed that was not opened");
    if (next().kind != Kind::end) refuse("there is an \"and\" or \"or\" missing before \"" + next().text + "\"");
    return expression;
  }

 private:
  const Token& next() const { return tokens_[at_]; }

  bool take(Kind kind) {
    if (next().kind != kind) return false;
    ++at_;
    return true;
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw std::invalid_argument("\"" + text_ + "\" is no expression: " + why);
  }

  Expression any() {
    Expression expression{Expression::Kind::any, {}, {all()}};
    while (take(Kind::disjunction)) expression.parts.push_back(all());
    return expression.parts.size() == 1 ? Expression(expression.parts[0]) : expression;
  }

  Expression all() {
    Expression expression{Expression::Kind::all, {}, {one()}};
    while (take(Kind::conjunction)) expression.parts.push_back(one());
    return expression.parts.size() == 1 ? Expression(expression.parts[0]) : expression;
  }

  Expression one() {
    if (++depth_ > kDeepest) refuse("it is nested too deeply");
    Expression expression;
    if (take(Kind::negation)) {
      expression = {Expression::Kind::negation, {}, {one()}};
    } else if (take(Kind::open)) {
      expression = any();
      if (!take(Kind::close)) refuse("a bracket is not closed before \"" + next().text + "\"");
    } else if (next().kind == Kind::condition) {
      expression = {Expression::Kind::condition, parse_condition(next().text), {}};
      ++at_;
    } else {
      refuse("a condition is missing before \"" + next().text + "\"");
    }
    --depth_;
    return expression;
  }

  const std::string& text_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Expression parse_expression(const std::string& text) { return Parser(text).whole(); }

Expression parse_all(const std::vector<std::string>& texts) {
  Expression expression;
  for (const std::string& text : texts) expression.parts.push_back(parse_expression(text));
  return expression;
}

bool has_operator(const std::string& text) {
  for (std::size_t at = 0; at < text.size(); at = is_quote(text[at]) ? behind_quotes(text, at) : at + 1) {
    if (text[at] == '=' || text[at] == '<' || text[at] == '>' || text[at] == '!') return true;
  }
  return false;
}

}  // namespace seapile::store
