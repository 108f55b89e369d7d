// The output of the commands when all goes well.
#include "argand_run.hpp"
#include "image/files.hpp"

namespace argand::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Commands : public ArgandTest {
protected:
    /// Renders a few pixels and expects success.
    Outcome render(const std::string& options, const std::string& scene = "cornell_glass.glb",
                   const std::string& environment = on_host) const {
        const Outcome run =
            argand("render '" + asset(scene) + "' --size 6x4 --spp 2 --photons 2000 " + options,
                   environment);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        return run;
    }
    /// The same, on the device under test.
    Outcome render_on_device(const std::string& options) const {
        return render(options, "cornell_glass.glb", "");
    }
};

TEST_F(Commands, HelpOfEachHasAnExample) {
    for (const char* command : {"", "render", "compare", "inspect", "devices", "bench"}) {
        const Outcome run = argand(std::string(command) + " --help");
        EXPECT_EQ(run.exit_code, 0) << command;
        EXPECT_EQ(run.error, "") << command;
        EXPECT_THAT(run.out, HasSubstr("Example")) << command;
        EXPECT_THAT(run.out, HasSubstr(std::string("argand ") + command)) << command;
    }
    EXPECT_THAT(argand("--version").out, HasSubstr("argand "));
}

TEST_F(Commands, TheSceneDecidesOnTheMethodUnlessAnOptionDoes) {
    const auto method_of = [&](const std::string& options, const std::string& scene) {
        render("-q -o a.png --json report.json " + options, scene);
        return nlohmann::json::parse(read_text(file("report.json")))
            .at("parameters")
            .at("method")
            .get<std::string>();
    };
    EXPECT_EQ(method_of("", "cornell_area.glb"), "photons");
    EXPECT_EQ(method_of("", "cornell_glass.glb"), "footprints");
    EXPECT_EQ(method_of("--smoothing 5", "cornell_area.glb"), "footprints");
    EXPECT_EQ(method_of("--method knn", "cornell_glass.glb"), "knn");
    const Outcome inspected = argand("inspect '" + asset("cornell_area.glb") + "'");
    EXPECT_THAT(inspected.out, HasSubstr("photons (default)"));
}

TEST_F(Commands, PictureIsNamedAfterTheScene) {
    const Outcome run = render_on_device("");
    EXPECT_THAT(files(), ElementsAre("cornell_glass.png"));
    EXPECT_THAT(run.out, HasSubstr("cornell_glass.png"));
}

TEST_F(Commands, QuietPrintsNothing) {
    const Outcome run = render("-q -o picture.png");
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.error, "");
}

TEST_F(Commands, SeveralOutputsHoldTheSamePictureAndItsLayers) {
    render("-q -o a.exr -o b.png --output c.exr --exposure +1");
    EXPECT_THAT(files(), ElementsAre("a.exr", "b.png", "c.exr"));
    EXPECT_TRUE(pixels("a.exr") == pixels("c.exr"));
    const std::vector<Layer> layers = read_image(file("a.exr"));
    for (const char* name : {"", "direct", "indirect", "caustic"}) {
        const Image* image = find_layer(layers, name);
        ASSERT_NE(image, nullptr) << name;
        EXPECT_EQ(image->width, 6);
        EXPECT_EQ(image->height, 4);
    }
}

TEST_F(Commands, ReportHoldsParametersTimesFluxAndMemory) {
    render_on_device("-q -o a.png --json report.json --bounces 3 --seed 7 --exposure 0.5 "
                     "--radius 0.25 --camera 0 --at 1.5");
    const nlohmann::json report = nlohmann::json::parse(read_text(file("report.json")));
    const nlohmann::json& p = report.at("parameters");
    EXPECT_EQ(p.at("method"), "footprints");
    EXPECT_EQ(p.at("width"), 6);
    EXPECT_EQ(p.at("height"), 4);
    EXPECT_EQ(p.at("spp"), 2);
    EXPECT_EQ(p.at("photons"), 2000);
    EXPECT_EQ(p.at("bounces"), 3);
    EXPECT_EQ(p.at("radius"), 0.25);
    EXPECT_EQ(p.at("seed"), 7);
    EXPECT_EQ(p.at("at"), 1.5);
    EXPECT_EQ(p.at("exposure"), 0.5);
    EXPECT_TRUE(p.contains("camera"));
    EXPECT_TRUE(p.contains("follow_roughness"));
    EXPECT_EQ(report.at("scene"), "cornell_glass.glb");
    EXPECT_THAT(report.at("outputs"), ElementsAre("a.png"));
    for (const char* key : {"backend", "name", "driver", "api_version", "kind", "subgroup_size"}) {
        EXPECT_TRUE(report.at("device").contains(key)) << key;
    }
    for (const char* key : {"load", "open_device", "render", "write"}) {
        EXPECT_GT(report.at("wall_seconds").at(key), 0) << key;
    }
    for (const char* step : {"file", "materials and images", "meshes"}) {
        EXPECT_GT(report.at("wall_seconds").at("load_steps").at(step), 0) << step;
    }
    ASSERT_FALSE(report.at("stages").empty());
    for (const nlohmann::json& stage : report.at("stages")) {
        EXPECT_GE(stage.at("gpu_seconds"), 0) << stage;
        EXPECT_GT(stage.at("runs"), 0) << stage;
    }
    EXPECT_EQ(report.at("photons_emitted"), 2000);
    EXPECT_GT(report.at("photons_stored"), 0);
    EXPECT_GT(report.at("photons_in_view"), 0);
    EXPECT_LT(report.at("photons_in_view"), report.at("photons_stored"));
    EXPECT_EQ(report.at("non_finite_samples"), 0);
    EXPECT_EQ(report.at("interrupted"), false);
    for (int channel = 0; channel < 3; ++channel) {
        const nlohmann::json& flux = report.at("flux");
        const double emitted = flux.at("emitted").at(channel);
        const double rest = flux.at("absorbed").at(channel).get<double>() +
                            flux.at("escaped").at(channel).get<double>() +
                            flux.at("cut").at(channel).get<double>() +
                            flux.at("lost").at(channel).get<double>();
        EXPECT_GT(emitted, 0);
        EXPECT_NEAR(emitted, rest, 1e-9 * emitted);
    }
    const nlohmann::json& memory = report.at("memory");
    std::uint64_t largest = 0;
    for (const auto& [name, bytes] : memory.at("peak_bytes_by_name").items()) {
        largest = std::max(largest, bytes.get<std::uint64_t>());
    }
    EXPECT_GT(largest, 0u);
    EXPECT_GE(memory.at("peak_bytes").get<std::uint64_t>(), largest);
}

TEST_F(Commands, PathTracingReportsNoPhotons) {
    const Outcome run = argand("render '" + asset("cornell_glass.glb") +
                               "' --size 6x4 --spp 2 -q -o a.png --method path --json report.json");
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const nlohmann::json report = nlohmann::json::parse(read_text(file("report.json")));
    EXPECT_EQ(report.at("parameters").at("method"), "path");
    EXPECT_EQ(report.at("photons_emitted"), 0);
    EXPECT_EQ(report.at("samples_per_pixel"), 2);
    EXPECT_FALSE(report.at("parameters").contains("flatness"));
}

TEST_F(Commands, ReportHoldsWhatFootprintsAreMadeBy) {
    render("-q -o a.png --json report.json --flatness 0.5 --caustic-smoothing 3 --uniform-kernel "
           "--paper-axes");
    const nlohmann::json p = nlohmann::json::parse(read_text(file("report.json"))).at("parameters");
    EXPECT_EQ(p.at("flatness"), 0.5);
    EXPECT_EQ(p.at("caustic_smoothing"), 3);
    EXPECT_EQ(p.at("kernel"), "uniform");
    EXPECT_EQ(p.at("paper_axes"), true);
    EXPECT_EQ(p.at("paper_reemission"), false);
    EXPECT_EQ(p.at("fixed_smoothing"), false);
    EXPECT_GT(p.at("largest_footprint"), 0);
    EXPECT_GT(p.at("largest_caustic_footprint"), 0);
}

TEST_F(Commands, BudgetThatAPassExceedsIsNoted) {
    const Outcome run = render("-o a.png --budget 0.001 --json report.json");
    EXPECT_THAT(run.error, HasSubstr("argand: note: rendering took "));
    EXPECT_THAT(run.error, HasSubstr("--budget"));
    const nlohmann::json report = nlohmann::json::parse(read_text(file("report.json")));
    EXPECT_EQ(report.at("passes"), 1);
    EXPECT_EQ(report.at("samples_per_pixel"), 2);
    ASSERT_FALSE(report.at("notes").empty());
    EXPECT_THAT(report.at("notes").back().get<std::string>(), HasSubstr("not the 0.001 s"));
}

TEST_F(Commands, TargetErrorIsMetAndReported) {
    const std::string scene =
        "render '" + asset("cornell_point.glb") + "' --size 48x48 --backend cpu ";
    const Outcome run = argand(scene + "--target-error 0.01 --seed 3 -o a.exr --json report.json");
    ASSERT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(run.error, HasSubstr("argand: picked "));
    EXPECT_THAT(run.error, HasSubstr("relMSE about"));
    const nlohmann::json report = nlohmann::json::parse(read_text(file("report.json")));
    const nlohmann::json& aim = report.at("aim");
    EXPECT_EQ(aim.at("target_error"), 0.01);
    EXPECT_EQ(aim.at("reached"), true);
    EXPECT_EQ(aim.at("expected").at(0).at("method"), report.at("parameters").at("method"));
    EXPECT_LE(aim.at("noise").get<double>() + aim.at("squared_bias").get<double>(), 0.01);
    ASSERT_EQ(argand(scene + "-q --method path --spp 512 -o truth.exr").exit_code, 0);
    const double error =
        nlohmann::json::parse(argand("compare a.exr truth.exr --json").out).at("relMSE");
    EXPECT_LT(error, 1.5 * 0.01);
    EXPECT_GT(error, 0.0005);
}

TEST_F(Commands, BudgetWithoutMethodPicksOne) {
    const Outcome run =
        argand("render '" + asset("cornell_point.glb") +
               "' --size 32x32 --backend cpu --budget 3 -o a.png --json report.json");
    ASSERT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(run.error, HasSubstr("argand: picked "));
    const nlohmann::json report = nlohmann::json::parse(read_text(file("report.json")));
    EXPECT_TRUE(report.at("aim").at("reached").is_null());
    EXPECT_EQ(report.at("parameters").at("budget"), 3);
    EXPECT_EQ(report.at("parameters").at("method"),
              report.at("aim").at("expected").at(0).at("method"));
}

TEST_F(Commands, CompareMeasuresAndDrawsTheDifference) {
    render("-q -o a.exr --seed 1");
    render("-q -o b.exr --seed 2");
    const Outcome run = argand("compare a.exr b.exr -o difference.png --json");
    EXPECT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(files(), ElementsAre("a.exr", "b.exr", "difference.png"));
    const nlohmann::json metrics = nlohmann::json::parse(run.out);
    EXPECT_GT(metrics.at("relMSE"), 0);
    const Outcome same = argand("compare a.exr a.exr --layer indirect");
    EXPECT_EQ(same.exit_code, 0) << same.error;
    EXPECT_THAT(same.out, HasSubstr("relMSE 0\n"));
}

TEST_F(Commands, InspectSaysWhatIsThere) {
    const Outcome text = argand("inspect '" + asset("cornell_glass.glb") + "'");
    EXPECT_EQ(text.exit_code, 0) << text.error;
    EXPECT_THAT(text.out, HasSubstr("triangles"));
    EXPECT_THAT(text.out, HasSubstr("KHR_materials_transmission"));
    const Outcome json = argand("inspect '" + asset("cornell_glass.glb") + "' --json");
    EXPECT_EQ(json.exit_code, 0) << json.error;
    EXPECT_TRUE(nlohmann::json::parse(json.out).is_object());
}

TEST_F(Commands, InspectSaysWhatWouldBeDone) {
    const auto plan = [this](const std::string& scene) {
        return nlohmann::json::parse(argand("inspect '" + asset(scene) + "' --json").out)
            .at("plan");
    };
    const auto required_by = [](const nlohmann::json& of,
                                const std::string& feature) -> std::string {
        for (const nlohmann::json& row : of.at("features")) {
            if (row.at("feature") == feature) {
                return row.at("required_by");
            }
        }
        return "";
    };
    const nlohmann::json glass = plan("cornell_glass.glb");
    EXPECT_EQ(glass.at("method"), "footprints");
    EXPECT_EQ(required_by(glass, "refraction"), "material 'glass sphere'");
    EXPECT_EQ(required_by(glass, "emissive_triangles"), "material 'light'");
    EXPECT_EQ(required_by(glass, "differentials"), "the method");
    EXPECT_THAT(glass.at("left_out").get<std::vector<std::string>>(), ::testing::Contains("ggx"));
    const nlohmann::json point = plan("cornell_point.glb");
    EXPECT_EQ(required_by(point, "refraction"), "");
    EXPECT_EQ(point.at("features").size(), 4u) << point;
    const Outcome text = argand("inspect '" + asset("cornell_glass.glb") + "'");
    EXPECT_THAT(text.out, HasSubstr("method      footprints (default)\nrequires    "));
    EXPECT_THAT(text.out, ::testing::Not(HasSubstr("  cube maps: ")));
    const Outcome maps =
        argand("inspect '" + asset("cornell_glass.glb") + "' --method image-space");
    EXPECT_THAT(maps.out, HasSubstr("method      image-space\nrequires    "));
    EXPECT_THAT(maps.out, HasSubstr("  cube maps: the method; 8 bytes per texel"));
    EXPECT_THAT(text.out, ::testing::Not(HasSubstr("\nwidths ")));
    EXPECT_THAT(text.out, HasSubstr("\nqueries     find photons through a tree; with --query "
                                    "simultaneous all together, with up to 256 MiB for photons\n"));
    const Outcome falling =
        argand("inspect '" + asset("cornell_glass.glb") + "' --method progressive");
    EXPECT_THAT(falling.out, HasSubstr("\nwidths      fall from pass to pass, as n^-0.25 "));
    const Outcome unknown =
        argand("inspect '" + asset("cornell_glass.glb") + "' --method imagespace");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.error, HasSubstr("image-space"));
    EXPECT_THAT(text.out, HasSubstr("  refraction: material 'glass sphere'\n"));
    EXPECT_THAT(text.out, HasSubstr("left out    "));
}

TEST_F(Commands, EverythingGivesTheSamePicture) {
    render("-q -o a.exr --json a.json");
    render("-q -o b.exr --json b.json --everything");
    EXPECT_TRUE(pixels("a.exr") == pixels("b.exr"));
    EXPECT_EQ(nlohmann::json::parse(read_text(file("b.json"))).at("parameters").at("everything"),
              true);
}

TEST_F(Commands, DevicesListsWhatThereIs) {
    const Outcome run = argand("devices");
    EXPECT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(run.out, HasSubstr("0: "));
    EXPECT_THAT(run.out, HasSubstr("backend cpu"));
}

TEST_F(Commands, BackendsDoTheSame) {
    render("-q -o a.exr --backend vulkan");
    render("-q -o b.exr --backend cpu");
    const Outcome compared = argand("compare a.exr b.exr --json");
    EXPECT_LT(nlohmann::json::parse(compared.out)["relMSE"].get<double>(), 1e-6);
    // Each stage waits for the device, which takes twice as long with validation.
    const Outcome stages =
        argand("compare-backends '" + asset("cornell_glass.glb") +
                   "' --size 8x8 --spp 1 --photons 500 --methods footprints,path --json",
               "ARGAND_VALIDATION=0");
    EXPECT_EQ(stages.exit_code, 0) << stages.error;
    const nlohmann::json report = nlohmann::json::parse(stages.out);
    EXPECT_GT(report["methods"]["footprints"]["isolated"].size(), 20u);
    EXPECT_GT(report["methods"]["path"]["end_to_end"].size(), 10u);
}

TEST_F(Commands, CapturesAreRecordedAndComparedWith) {
    const std::string compare = "compare-backends '" + asset("cornell_area.glb") + "' ";
    const Outcome recorded =
        argand(compare + "--a cpu --record a.golden --size 6x6 --spp 1 --photons 200 --revision r1 "
                         "--methods footprints,path");
    EXPECT_EQ(recorded.exit_code, 0) << recorded.error;
    const Outcome compared =
        argand(compare + "--a vulkan --b golden --golden a.golden", "ARGAND_VALIDATION=0");
    EXPECT_EQ(compared.exit_code, 0) << compared.error;
    EXPECT_THAT(compared.out, HasSubstr("r1"));
}

TEST_F(Commands, DeviceByNameAndByIndex) {
    const Outcome devices = argand("devices");
    const std::size_t begin = devices.out.find(": ") + 2;
    const std::string name = devices.out.substr(begin, devices.out.find(' ', begin) - begin);
    render_on_device("-q -o a.exr --device 0");
    render_on_device("-q -o b.exr --device '" + name + "'");
    EXPECT_THAT(files(), ElementsAre("a.exr", "b.exr"));
}

TEST_F(Commands, SlowBenchPrintsARowForEachMeasurement) {
    // Buffers of 1 MiB allow only the small sizes. Without time stamps the wall clock is used.
    for (const char* disable : {"", " ARGAND_DISABLE=timestamps"}) {
        const Outcome run = argand("bench parallel --json",
                                   std::string("ARGAND_LIMIT=storage_range=1MiB") + disable);
        ASSERT_EQ(run.exit_code, 0) << run.error;
        const nlohmann::json rows = nlohmann::json::parse(run.out);
        ASSERT_FALSE(rows.empty());
        for (const nlohmann::json& row : rows) {
            std::vector<std::string> keys;
            for (const auto& [key, value] : row.items()) {
                keys.push_back(key);
            }
            EXPECT_THAT(keys,
                        ::testing::UnorderedElementsAre("name", "n", "seconds", "rate", "unit",
                                                        "bound", "peer", "peer_rate"));
            EXPECT_GT(row.at("seconds"), 0) << row;
            const double items = row.at("rate").get<double>() * row.at("seconds").get<double>();
            EXPECT_NEAR(items, row.at("n"), 1e-6 * items) << row;
            EXPECT_GT(row.at("bound"), 0) << row;
            EXPECT_GT(row.at("peer_rate"), 0) << row;
            EXPECT_NE(row.at("peer"), "") << row;
        }
    }
}

TEST_F(Commands, NotesSayWhatWasMadeUp) {
    const Outcome run = render("-o a.png", "sky_room.glb");
    EXPECT_THAT(run.error, HasSubstr("argand: note: "));
    EXPECT_THAT(run.error, HasSubstr("studio"));
}

} // namespace
} // namespace argand::testing
