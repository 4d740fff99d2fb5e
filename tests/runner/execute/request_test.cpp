#include "runner/execute/request.h"

#include <gtest/gtest.h>

#include "runner/study/study.h"

namespace seapile::execute {
namespace {

Request a_drive() {
  Request request;
  request.root = "/some/where";
  request.kind = "drive";
  request.scene.pile.emplace();
  request.scene.pile->radius = 0.1;
  request.bed_id = study::case_id(study::canonical_text(request.scene.bed));
  request.bed_run = "0003";
  request.canonical = study::canonical_text(request.scene, request.bed_id);
  request.case_id = study::case_id(request.canonical);
  request.record.frames = {0, 0.1};
  request.threads = 3;
  request.checkpoint_every = 0.25;
  request.parent = 42;
  return request;
}

TEST(Request, ComesBackAsItWasSent) {
  const Request sent = a_drive(), read = request_from_json(to_json(sent), "-");
  EXPECT_EQ(read.root, sent.root);
  EXPECT_EQ(read.kind, sent.kind);
  EXPECT_EQ(read.case_id, sent.case_id);
  EXPECT_EQ(read.canonical, sent.canonical);
  EXPECT_EQ(read.scene, sent.scene);
  EXPECT_EQ(read.record, sent.record);
  EXPECT_EQ(read.bed_id, sent.bed_id);
  EXPECT_EQ(read.bed_run, sent.bed_run);
  EXPECT_EQ(read.threads, sent.threads);
  EXPECT_EQ(read.checkpoint_every, sent.checkpoint_every);
  EXPECT_EQ(read.parent, sent.parent);
}

TEST(Request, ABasinComesBackWithItsRecord) {
  Request sent;
  sent.root = "/some/where";
  sent.kind = "flow";
  sent.scene.basin.emplace().surface.reset();
  sent.canonical = study::canonical_text(sent.scene, "");
  sent.case_id = study::case_id(sent.canonical);
  sent.record.interval = 0.125;
  sent.record.times = {0.25, 0.5};
  const Request read = request_from_json(to_json(sent), "-");
  EXPECT_EQ(read.scene, sent.scene);
  EXPECT_EQ(read.record, sent.record);
  sent.kind = "drive";
  EXPECT_THROW(request_from_json(to_json(sent), "-"), study::BadInput);
}

TEST(Request, WhatDoesNotFitTogetherIsRefused) {
  const auto refused = [](auto change) {
    Request request = a_drive();
    change(request);
    EXPECT_THROW(request_from_json(to_json(request), "-"), study::BadInput);
  };
  refused([](Request& r) { r.kind = "flight"; });
  refused([](Request& r) { r.scene.pile.reset(); });
  refused([](Request& r) { r.threads = 0; });
  refused([](Request& r) { r.checkpoint_every = -1; });
  refused([](Request& r) { r.case_id[0] = r.case_id[0] == '0' ? '1' : '0'; });
  refused([](Request& r) { r.canonical += " "; });
  refused([](Request& r) { r.bed_id = "../../elsewhere"; });
  refused([](Request& r) { r.bed_run = "../0001"; });
  EXPECT_THROW(request_from_json("{}", "-"), study::BadInput);
  EXPECT_THROW(request_from_json("no JSON", "-"), study::BadInput);
}

}  // namespace
}  // namespace seapile::execute
