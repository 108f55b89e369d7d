#include "base/json.hpp"
#include "support/expect_error.hpp"
#include "support/scratch_directory.hpp"
#include <limits>

using namespace argand;
using namespace argand::testing;

namespace {

TEST(Json, KeepsOrderAndEndsWithANewline) {
    EXPECT_EQ(json_text({{"z", 1}, {"a", {1.5, "x"}}}),
              "{\n  \"z\": 1,\n  \"a\": [\n    1.5,\n    \"x\"\n  ]\n}\n");
}

TEST(Json, ReplacesValuesThatJsonCannotExpress) {
    EXPECT_EQ(json_text(std::numeric_limits<double>::infinity()), "null\n");
    EXPECT_EQ(json_text(std::numeric_limits<double>::quiet_NaN()), "null\n");
    EXPECT_EQ(json_text("caf\xe9"), "\"caf\xef\xbf\xbd\"\n");
}

TEST(Json, WritesAFile) {
    const ScratchDirectory scratch;
    write_json(scratch / "report.json", {{"photons", 200000}});
    EXPECT_EQ(nlohmann::json::parse(read_text(scratch / "report.json")).at("photons"), 200000);
    EXPECT_THAT(error_of([&] { write_json(scratch / "none/report.json", {}); }),
                ::testing::HasSubstr("none/report.json"));
}

} // namespace
