#include "runner/store/expression.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace seapile::store {
namespace {

/// With every bracket written, and each condition as its path.
std::string shape(const Expression& expression) {
  if (expression.kind == Expression::Kind::condition) return expression.condition.path;
  if (expression.kind == Expression::Kind::negation) return "!" + shape(expression.parts.at(0));
  std::string text;
  for (const Expression& part : expression.parts) {
    if (!text.empty()) text += expression.kind == Expression::Kind::all ? "&" : "|";
    text += shape(part);
  }
  return "(" + text + ")";
}

TEST(Expression, NotBindsClosestThenAnd) {
  const auto expect = [](const char* text, const char* as) { EXPECT_EQ(shape(parse_expression(text)), as) << text; };
  expect("a=1", "a");
  expect("a=1 and b=2", "(a&b)");
  expect("a=1 or b=2 and c=3", "(a|(b&c))");
  expect("a=1 and b=2 or c=3", "((a&b)|c)");
  expect("(a=1 or b=2) and c=3", "((a|b)&c)");
  expect("not a=1 and b=2", "(!a&b)");
  expect("not (a=1 and b=2)", "!(a&b)");
  expect("not not a=1", "!!a");
  expect("a=1 AND (NOT(b=2)Or c=3)", "(a&(!b|c))");
  expect("((a=1))", "a");
}

TEST(Expression, KeepsTheTextOfAConditionAsItIs) {
  const auto value = [](const char* text) {
    return std::get<std::string>(parse_expression(text).parts.at(0).condition.value);
  };
  EXPECT_EQ(value("a = 0.2 m/s and b = 1"), "0.2 m/s");
  EXPECT_EQ(value("a > 0.2 m/s and b = 1"), "0.2 m/s");
  EXPECT_EQ(value("a = 'salt and (pepper)' and b = 1"), "salt and (pepper)");
  EXPECT_EQ(value("a = \"b  or  c\" and b = 1"), "b  or  c");
  EXPECT_EQ(parse_expression("android = 1 and b = 1").parts.at(0).condition.path, "android");
}

TEST(Expression, IsRefusedWithAReason) {
  for (const char* text : {"", "and", "a=1 and", "and a=1", "a=1 or or b=1", "not", "(a=1", "a=1)", "()", "a",
                           "a=1 b=2", "a=1 (b=2)", "a=1 not b=2", "a < flat and b=1", "a = 'b and c=1"}) {
    EXPECT_THROW(parse_expression(text), std::invalid_argument) << text;
  }
  EXPECT_THROW(parse_expression(std::string(100'000, '(')), std::invalid_argument);
  std::string negations;
  for (int i = 0; i < 100'000; ++i) negations += "not ";
  EXPECT_THROW(parse_expression(negations + "a=1"), std::invalid_argument);
}

TEST(Expression, IsToldFromAName) {
  for (const char* text : {"a=1", "a<b", "a != 'x'", "b > 2"}) EXPECT_TRUE(has_operator(text)) << text;
  for (const char* text : {"tip_shape", "'a=1'", "", "studies/tip.json"}) EXPECT_FALSE(has_operator(text)) << text;
}

TEST(Expression, OfNothingHoldsForEveryRun) {
  EXPECT_EQ(shape(parse_all({})), "()");
  EXPECT_EQ(shape(parse_all({"a=1 or b=1", "c=1"})), "((a|b)&c)");
}

}  // namespace
}  // namespace seapile::store
