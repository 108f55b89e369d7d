// `argand bench --paper` on small pictures and loads.
#include "argand_run.hpp"

namespace argand::testing {
namespace {

class PaperBench : public ArgandTest {
protected:
    nlohmann::json measure(const std::string& part,
                           const std::string& environment = on_host) const {
        const Outcome run =
            argand("bench --paper fd09 --json --size 16 --error-size 8 --photons 2000 --runs 1 "
                   "--reference-samples 16 --part " +
                       part + " --scene '" + asset("cornell_area.glb") + "'",
                   environment);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        return nlohmann::json::parse(run.out);
    }
};

TEST_F(PaperBench, LeafSizesOfBothBuilds) {
    const nlohmann::json rows = measure("table1", ""); // on the device under test
    ASSERT_EQ(rows.size(), 3u);
    for (std::size_t build = 0; build < 2; ++build) {
        EXPECT_EQ(rows[build]["scene"], "cornell_area");
        EXPECT_GT(rows[build]["hits"], 500);
        for (const char* leaf_size : {"1", "2", "4", "8", "16", "32", "64", "128", "256", "512"}) {
            EXPECT_GT(rows[build][leaf_size], 0) << leaf_size;
        }
        EXPECT_GT(rows[build]["T_auto of best [%]"], 0);
        EXPECT_LE(rows[build]["T_auto of best [%]"].get<double>(), 100 + 1e-9);
    }
    EXPECT_GT(rows[2]["in the map"], rows[0]["hits"]);
    EXPECT_GT(rows[2]["VVH build [ms]"], 0);
}

TEST_F(PaperBench, RadiiCountEveryFootprint) {
    const nlohmann::json hits = measure("figure5");
    const nlohmann::json rows = measure("table3");
    ASSERT_EQ(rows.size(), 1u);
    std::uint64_t sum = 0;
    for (const auto& [key, value] : rows[0].items()) {
        sum += value.is_number_unsigned() ? value.get<std::uint64_t>() : 0;
    }
    EXPECT_EQ(sum, hits[0]["hits"].get<std::uint64_t>());
}

TEST_F(PaperBench, SharesAddUp) {
    const nlohmann::json rows = measure("figure5");
    const nlohmann::json& row = rows[0];
    EXPECT_NEAR(row["tracing [%]"].get<double>() + row["building [%]"].get<double>() +
                    row["rendering [%]"].get<double>(),
                100, 1e-6);
    EXPECT_GT(row["frame [s]"], 0);
}

TEST_F(PaperBench, EstimatorsAndKernelsAtEqualError) {
    const nlohmann::json rows = measure("table2");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_GT(rows[0]["footprints [s]"], 0);
    EXPECT_TRUE(rows[0].contains("photons / footprints"));
    EXPECT_NE(rows[1]["relMSE, uniform"], rows[1]["relMSE, Epanechnikov"]);
}

TEST_F(PaperBench, HitsInCubeMaps) {
    const Outcome run = argand("bench --paper ywcyp10 --part hits --photons 300 --runs 1 --json "
                               "--scene '" +
                                   asset("cornell_point.glb") + "'",
                               on_host);
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const nlohmann::json rows = nlohmann::json::parse(run.out);
    ASSERT_GT(rows.size(), 10u);
    for (const nlohmann::json& row : rows) {
        EXPECT_LE(row["equal"], row["right"]);
        EXPECT_LE(
            row["right"].get<double>() + row["wrong"].get<double>() + row["lost"].get<double>(), 1);
    }
    // As published, and by triangles with a march of 32.
    EXPECT_LT(rows[0]["right"], 0.9);
    EXPECT_GT(rows[5]["right"], 0.98);
    expect_failure("bench --paper ywcyp10 --part table1", 2,
                   "no part 'table1'; choose from making, images, hits");
}

TEST_F(PaperBench, SimultaneousQueriesAgainstATree) {
    const Outcome run = argand("bench --paper kdgs10 --json --most-queries 1000 --most-photons "
                               "10000 --runs 1",
                               "");
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const nlohmann::json rows = nlohmann::json::parse(run.out);
    ASSERT_EQ(rows.size(), 4u); // near and far, in rows and scattered
    for (const nlohmann::json& row : rows) {
        EXPECT_GT(row["speedup"], 0);
        EXPECT_GE(row["pairs over useful"], 1);
        EXPECT_GE(row["box tests a photon"], 1);
        EXPECT_EQ(row["entered"].get<double>() == 1, row["where"] == "near");
        EXPECT_GT(row["MiB"], 0);
        EXPECT_GT(row["pairs bound s"], 0);
        EXPECT_LT(row["pairs bound s"], row["together: answer s"]);
    }
}

TEST_F(PaperBench, PhotonsQueueWritesAPageAndResumes) {
    const std::string command = "bench --paper shi12 --quick --runs 1 --scenes '" +
                                std::string(ARGAND_SOURCE_DIR) + "/assets' -o '" + file("shi12") +
                                "'";
    const Outcome first = argand(command, on_host);
    ASSERT_EQ(first.exit_code, 0) << first.error;
    const std::string page = read_text(file("shi12/shi12.md"));
    for (const char* title : {"Figure 4.1", "Figures 4.2 and 4.3", "Figure 4.4", "Figure 4.5",
                              "Figures 4.11 to 4.13"}) {
        EXPECT_NE(page.find(title), std::string::npos) << title;
    }
    const nlohmann::json rows = nlohmann::json::parse(read_text(file("shi12/shi12.json")))["rows"];
    EXPECT_GT(rows["construction, 2000 photons"]["kd-tree / update"], 0);
    EXPECT_GT(rows["memory, 2000 photons"]["queue: at rest [MiB]"], 0);
    EXPECT_EQ(rows["film"].size(), 11u);
    EXPECT_GT(rows["film"][10]["queue: relMSE"], 0);
    const Outcome again = argand(command, on_host);
    EXPECT_EQ(again.exit_code, 0);
    EXPECT_EQ(again.error, ""); // nothing is measured again
    EXPECT_EQ(read_text(file("shi12/shi12.md")), page);
}

TEST_F(PaperBench, UnknownPapersAndPartsAreRefused) {
    expect_failure("bench --paper shi12 --json", 2, "--json");
    expect_failure("bench --paper fd09 --quick", 2, "--quick");
    expect_failure("bench --paper shi12 --scenes nowhere", 1, "--scenes", on_host);
    expect_failure("bench --paper shi12 --scenes '" + asset(".") + "' -o /proc/nowhere", 1, "",
                   on_host);
    expect_failure("bench --paper jensen96", 2, "--paper");
    expect_failure("bench --paper fd09 --part table9", 2, "--part");
    expect_failure("bench --part table1", 2, "--paper");
    expect_failure("bench --paper kdgs10 --part table1", 2, "--part");
    expect_failure("bench --paper fd09 --most-queries 1000", 2, "--most-queries");
    expect_failure("bench --paper fd09", 1, "--scene"); // not in the project's folder
}

} // namespace
} // namespace argand::testing
