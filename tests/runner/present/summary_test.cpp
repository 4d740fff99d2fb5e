#include "runner/present/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace seapile::present {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

CaseResult a_case(const Labels& labels) { return {std::string(64, 'a'), labels, "failed", {}, {}}; }

TEST(Summary, ACaseWithoutAResultIsListedWithItsOutcome) {
  const store::Table table = summary({a_case({{"pile.tip", "flat"}})});
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0].size(), table.columns.size());
  EXPECT_EQ(table.units.size(), table.columns.size());
  EXPECT_EQ(table.rows[0][0], store::Cell(std::string("aaaaaaaaaa")));
  EXPECT_EQ(table.rows[0][1], store::Cell(std::string("flat")));
  EXPECT_EQ(table.rows[0][2], store::Cell(std::string("failed")));
  for (std::size_t i = 3; i < table.columns.size(); ++i) EXPECT_EQ(table.rows[0][i], store::Cell());
}

TEST(ClosingText, OnePackingIsCalledOne) {
  EXPECT_THAT(closing_text({a_case({{"pile.tip", "flat"}}), a_case({{"pile.tip", "conical"}})}),
              HasSubstr("one packing: no interval"));
  EXPECT_THAT(closing_text({a_case({})}), HasSubstr("one packing: no interval"));
}

TEST(ClosingText, SeveralPackingsOfACaseAreOneRow) {
  const std::string text = closing_text({a_case({{"pile.tip", "flat"}, {"bed.seed", "1"}}),
                                         a_case({{"pile.tip", "flat"}, {"bed.seed", "2"}}),
                                         a_case({{"pile.tip", "conical"}, {"bed.seed", "1"}})});
  EXPECT_EQ(text.find("flat"), text.rfind("flat"));
  EXPECT_THAT(text, Not(HasSubstr("bed.seed")));
  EXPECT_THAT(text, HasSubstr("3 runs are not completed and left out"));
}

TEST(ResistanceFigure, WithoutACompletedDriveThereIsNothingToDraw) {
  EXPECT_THAT(resistance_figure("title", {a_case({})}).groups, IsEmpty());
}

}  // namespace
}  // namespace seapile::present
