#include "runner/store/condition.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace seapile::store {
namespace {

using Op = Condition::Op;

void expect(const std::string& text, const std::string& path, Op op, const decltype(Condition::value)& value) {
  const Condition condition = parse_condition(text);
  EXPECT_EQ(condition.path, path) << text;
  EXPECT_EQ(condition.op, op) << text;
  EXPECT_EQ(condition.value, value) << text;
}

TEST(Condition, IsPathOpValue) {
  expect("bed.seed=3", "bed.seed", Op::equal, 3.0);
  expect("  bed.seed  <=  3  ", "bed.seed", Op::less_equal, 3.0);
  expect("pile.radius>1e-1", "pile.radius", Op::greater, 0.1);
  expect("pile.radius>=-0.5", "pile.radius", Op::greater_equal, -0.5);
  expect("x<2", "x", Op::less, 2.0);
  expect("pile.tip != flat", "pile.tip", Op::not_equal, std::string("flat"));
  expect("tip_resistance_0.20-0.25 > 1", "tip_resistance_0.20-0.25", Op::greater, 1.0);
  expect("fluid = null", "fluid", Op::equal, std::monostate{});
}

TEST(Condition, TakesATextInQuotesAsItIs) {
  expect("outcome = 'two words'", "outcome", Op::equal, std::string("two words"));
  expect("x = \"it's\"", "x", Op::equal, std::string("it's"));
  expect("x = \"3\"", "x", Op::equal, std::string("3"));
  expect("x = ''", "x", Op::equal, std::string());
  expect("x = '; DROP TABLE run; --'", "x", Op::equal, std::string("; DROP TABLE run; --"));
}

TEST(Condition, IsRefusedWithAReason) {
  for (const char* text :
       {"", " ", "pile.tip", "= 3", "pile.tip flat", "pile.tip =", "a b = 3", "a = b = c", "a == 3", "a <> 3", "a = 'b",
        "a = b'", "a = 'b'c'", "'a' = 3", "a =< 3", "a ! 3", "a < flat", "a >= null", "a = <3"}) {
    EXPECT_THROW(parse_condition(text), std::invalid_argument) << text;
  }
}

TEST(Condition, KnowsNumbersFromWords) {
  for (const char* text : {"a = nan", "a = inf", "a = 1e400", "a = 3m", "a = 0x10", "a = 1 2"}) {
    EXPECT_TRUE(std::holds_alternative<std::string>(parse_condition(text).value)) << text;
  }
}

}  // namespace
}  // namespace seapile::store
