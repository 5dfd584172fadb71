#include "hmi_bridge/traces/recordings.hpp"

#include <gtest/gtest.h>

namespace lockstep::recordings_test {
namespace {

/// What is removed one day has to be a recording: its name says so in full.
TEST(Recordings, KnowTheirOwnNamesAlone) {
  EXPECT_EQ(Recordings::number_of("rec_20261123T115200Z_17.csv", "rec"), 17u);
  for (const char* foreign :
       {"rec_99999999T999999Z_2.csv", "rec_20261323T115200Z_2.csv", "rec_20261100T115200Z_2.csv",
        "rec_20261123T245200Z_2.csv", "rec_20261123T115200Z_02.csv", "rec_20261123T115200Z_.csv",
        "rec_20261123T115200Z_2.csv.bak", "rec_20261123_2.csv", "xrec_20261123T115200Z_2.csv", "rec.csv", ""})
    EXPECT_EQ(Recordings::number_of(foreign, "rec"), 0u) << foreign;
}

}  // namespace
}  // namespace lockstep::recordings_test
