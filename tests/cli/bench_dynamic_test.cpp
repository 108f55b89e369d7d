// argand bench --dynamic, the measurement of films.
#include "argand_run.hpp"

#include <filesystem>
#include <sstream>

namespace argand::testing {
namespace {

class BenchDynamic : public ArgandTest {
protected:
    static std::string bench(const std::string& options) {
        return "bench --dynamic --scenes '" + asset("") + "' " + options;
    }
    /// The cells of a line of CSV.
    static std::vector<std::string> cells(const std::string& line) {
        std::vector<std::string> found;
        std::istringstream in(line);
        for (std::string cell; std::getline(in, cell, ',');) {
            found.push_back(cell);
        }
        return found;
    }
};

TEST_F(BenchDynamic, RefusesWhatItCannotMeasure) {
    expect_failure(bench("--film no_such_film"), usage, "no_such_film", on_host);
    expect_failure("bench --dynamic --scenes nowhere", failure, "cornell_glass.glb", on_host);
    expect_failure("bench --film cornell_glass", usage, "--dynamic", on_host);
    expect_failure("bench --quick", usage, "--dynamic", on_host);
    expect_failure("bench --dynamic --paper fd09", usage, "--paper", on_host);
}

TEST_F(BenchDynamic, SlowMeasuresEveryFrameOnce) {
    const std::string command = bench("--quick --film cornell_glass -o out");
    Outcome run = argand(command, on_host);
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const std::string table = read_text(file("out/dynamic.csv"));
    std::istringstream lines(table);
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> columns = cells(line);
    EXPECT_EQ(columns[0], "film");
    EXPECT_EQ(columns[8], "rel_mse");
    EXPECT_EQ(columns[11], "flicker");
    int rows = 0;
    while (std::getline(lines, line)) {
        const std::vector<std::string> row = cells(line);
        EXPECT_EQ(row[0], "cornell_glass");
        EXPECT_EQ(row[2], std::to_string(rows % 2));
        EXPECT_GT(std::stod(row[3]), 0);
        EXPECT_GT(std::stod(row[8]), 0);
        // Nothing moves, and noise stands still but for the order in which sums are taken.
        EXPECT_EQ(row[11].empty(), rows % 2 == 0);
        EXPECT_LT(row[11].empty() ? 0 : std::stod(row[11]), 1e-12);
        EXPECT_EQ(row[12], "0");
        ++rows;
    }
    // By seven methods, and by the photons queue with four windows and two trees.
    EXPECT_EQ(rows, 2 * (7 + 6));
    EXPECT_NE(table.find("\ncornell_glass,photon-queue W=64,1,"), std::string::npos);
    EXPECT_NE(table.find("\ncornell_glass,photon-queue rebuild=kdtree,1,"), std::string::npos);
    // It has been measured.
    const auto before = std::filesystem::last_write_time(file("out/cornell_glass.json"));
    run = argand(command, on_host);
    EXPECT_EQ(run.exit_code, 0) << run.error;
    EXPECT_EQ(std::filesystem::last_write_time(file("out/cornell_glass.json")), before);
    EXPECT_EQ(read_text(file("out/dynamic.csv")), table);
}

} // namespace
} // namespace argand::testing
