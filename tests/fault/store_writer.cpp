// A worker in small: claims the sample's case, goes on where an earlier attempt was, seals three checkpoints, finishes,
// and has the run ingested. Each line on standard output is a promise: what it says is durable by then.
#include <unistd.h>

#include <cstdio>
#include <exception>

#include "runner/store/catalogue.h"
#include "runner/store/run_folder.h"
#include "tests/fault/store_writer.h"
#include "tests/runner/store/sample_run.h"

namespace {

using namespace seapile::store;

void promise(const std::string& what) {
  const std::string line = what + "\n";
  if (::write(STDOUT_FILENO, line.data(), line.size()) != static_cast<ssize_t>(line.size())) ::_exit(fault::kConfused);
}

void drive(const std::filesystem::path& folder) {
  RunWriter writer(folder, sample::drive_header());
  const Resumable& resumable = writer.resumable();
  const std::size_t first = resumable.records.size();
  // Going on from anything but what was sealed would give a plausible wrong result.
  if (!fault::is_expected(resumable)) ::_exit(fault::kConfused);
  for (std::size_t i = first; i < fault::kRecords; ++i) {
    if (i % fault::kFrameEvery == 0) writer.add(fault::frame(i / fault::kFrameEvery));
    writer.add(sample::record(i));
    if ((i + 1) % fault::kCheckpointEvery == 0) {
      writer.checkpoint(sample::state(i + 1));
      promise("checkpoint " + std::to_string(i + 1));
    }
  }
  writer.finish(sample::drive_result(), sample::provenance(), nullptr);
  promise("finished");
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return fault::kConfused;
  const std::filesystem::path root = arguments[1];
  try {
    const std::filesystem::path home = case_folder(root, sample::drive_header().case_id);
    const auto claim = Claim::take(home);
    if (!claim) return fault::kConfused;
    if (complete_runs(home).empty()) drive(home / next_run(home, true));
    const std::filesystem::path folder = home / complete_runs(home).back();
    Catalogue catalogue = Catalogue::open(root);
    catalogue.put(fault::study());
    catalogue.ingest(folder);
    promise("ingested");
  } catch (const StoreError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    ::_exit(fault::kFirstError + static_cast<int>(error.kind));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    ::_exit(fault::kConfused);
  }
  return 0;
}
