// Writes the store that results_schema/golden/v1 is. Not a test: it was run once, and is kept to show how.
#include <cstdio>

#include "runner/store/catalogue.h"
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
                 "is version 1 still read?",
                 std::string(64, '0'),
                 {{written.drive.parent_path().filename(), {{"pile.tip", "flat"}}}}});
  catalogue.ingest(written.bed);
  catalogue.ingest(written.drive);
}
