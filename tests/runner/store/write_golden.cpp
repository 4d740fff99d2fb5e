// Writes a store as those below results_schema/golden are, of today's schema. Not a test: it is run once, before the
// schema moves on, and catalogue.lock, which only a writer needs, is left out.
#include <cstdio>

#include "runner/store/catalogue.h"
#include "runner/store/database.h"
#include "tests/runner/store/sample_run.h"

int main(int count, char** arguments) {
  using namespace seapile::store;
  if (count != 2 || std::filesystem::exists(arguments[1])) {
    std::fprintf(stderr, "usage: write_golden <a folder that is not there yet>\n");
    return 2;
  }
  const std::filesystem::path root = arguments[1];
  const sample::Written written = sample::write(root);
  Catalogue catalogue = Catalogue::open(root);
  catalogue.put({"golden",
                 "is version " + std::to_string(kCatalogueVersion) + " still read?",
                 std::string(64, '0'),
                 {{written.drive.parent_path().filename(), {{"pile.tip", "flat"}}}}});
  catalogue.ingest(written.bed);
  catalogue.ingest(written.drive);
}
