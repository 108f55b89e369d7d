#include "results.hpp"

#include "base/environment.hpp"

#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

namespace argand::testing {

namespace {

nlohmann::json& results() {
    static nlohmann::json all = nlohmann::json::object();
    return all;
}

class WriteResults : public ::testing::Environment {
public:
    void TearDown() override {
        const std::string path = environment("ARGAND_NUMERICS_RESULTS");
        if (path.empty()) {
            return;
        }
        const ::testing::UnitTest& run = *::testing::UnitTest::GetInstance();
        for (int suite = 0; suite < run.total_test_suite_count(); ++suite) {
            const ::testing::TestSuite& tests = *run.GetTestSuite(suite);
            for (int i = 0; i < tests.total_test_count(); ++i) {
                const ::testing::TestInfo& test = *tests.GetTestInfo(i);
                if (test.should_run()) {
                    record_result("tests", {{"name", fmt::format("{}.{}", test.test_suite_name(),
                                                                 test.name())},
                                            {"result", test.result()->Failed()    ? "failed"
                                                       : test.result()->Skipped() ? "skipped"
                                                                                  : "passed"}});
                }
            }
        }
        std::ofstream file(path);
        file << results().dump(1) << '\n';
        ASSERT_TRUE(file.flush()) << path;
    }
};

const ::testing::Environment* const writes_results =
    ::testing::AddGlobalTestEnvironment(new WriteResults);

} // namespace

void record_result(const std::string& section, const nlohmann::json& row) {
    results()[section].push_back(row);
}

void record_extreme(const std::string& extreme, const std::string& expectation,
                    const std::string& measured) {
    const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
    record_result("extremes", {{"extreme", extreme},
                               {"expectation", expectation},
                               {"measured", measured},
                               {"test", fmt::format("test_numerics: {}.{}", test.test_suite_name(),
                                                    test.name())}});
}

std::string shown(double number) { return fmt::format("{:.2g}", number); }

} // namespace argand::testing
