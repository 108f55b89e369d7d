// argand view, without a window, and the edits of other commands.
#include "argand_run.hpp"

namespace argand::testing {
namespace {

using ::testing::HasSubstr;

class ViewCommand : public ArgandTest {
protected:
    std::string view(const std::string& options) const {
        return "view '" + asset("cornell_point.glb") +
               "' --headless --size 16x12 --photons 1000 --method photons " + options;
    }
    void write(const std::string& name, const std::string& text) const {
        write_text(file(name), text);
    }
};

TEST_F(ViewCommand, TellsTheCommandThatMakesItsPicture) {
    write("script.json", R"({"frames": 6, "events": [
        {"frame": 1, "edits": {"lights": {"point": {"position": [0.4, 1.2, 0.1]}}}},
        {"frame": 2, "edits": {"nodes": {"tall box": {"translation": [0.1, 0, 0.2]}}},
         "options": {"query-cell": 0, "least-coverage": 0.2}},
        {"frame": 5, "save_edits": "edits.json", "screenshot": "shown.exr",
         "expect": {"passes": 3}}]})");
    const Outcome run = argand(view("--script script.json --json frames.json"), on_host);
    ASSERT_EQ(run.exit_code, 0) << run.error;
    EXPECT_EQ(run.error, "");
    EXPECT_THAT(run.out, HasSubstr("6 frames, 3 of them previews"));
    EXPECT_THAT(run.out, HasSubstr("3 passes at rest"));
    std::string command = run.out.substr(run.out.find("argand render ") + 7);
    command = command.substr(0, command.find('\n'));
    EXPECT_THAT(command, HasSubstr("--edits edits.json"));
    EXPECT_THAT(command, HasSubstr("--query-cell 0"));
    ASSERT_EQ(argand(command + " -q -o rendered.exr", on_host).exit_code, 0) << command;
    EXPECT_EQ(pixels("shown.exr"), pixels("rendered.exr"));
    const std::string frames = read_text(file("frames.json"));
    EXPECT_EQ(std::count(frames.begin(), frames.end(), '\n'), 6);
    const nlohmann::json first = nlohmann::json::parse(frames.substr(0, frames.find('\n')));
    EXPECT_EQ(first["moving"], true);
    EXPECT_EQ(first["passes"], 0);
}

TEST_F(ViewCommand, GoesOnFromEdits) {
    write("edits.json", R"({"lights": {"0": {"intensity": [1, 0, 0]}}})");
    write("script.json", R"({"frames": 2, "events": [{"frame": 1, "screenshot": "shown.exr"}]})");
    ASSERT_EQ(argand(view("-q --script script.json --edits edits.json"), on_host).exit_code, 0);
    const std::string render = "render '" + asset("cornell_point.glb") +
                               "' -q --size 16x12 --photons 1000 --spp 1 --method photons "
                               "--progressive --passes 1 -o rendered.exr ";
    ASSERT_EQ(argand(render + "--edits edits.json", on_host).exit_code, 0);
    EXPECT_EQ(pixels("shown.exr"), pixels("rendered.exr"));
    ASSERT_EQ(argand(render, on_host).exit_code, 0);
    EXPECT_NE(pixels("shown.exr"), pixels("rendered.exr"));
    const Outcome inspect =
        argand("inspect '" + asset("cornell_point.glb") + "' --edits edits.json", on_host);
    EXPECT_THAT(inspect.out, HasSubstr("1 0 0 candela"));
    EXPECT_THAT(inspect.out, HasSubstr("tall box"));
}

TEST_F(ViewCommand, EditsFilms) {
    write("edits.json", R"({"lights": {"0": {"position": [0.3, 1, 0]}}})");
    const std::string render = "render '" + asset("dynamic_block.glb") +
                               "' -q --size 12x12 --spp 1 --photons 500 --method photons "
                               "--edits edits.json ";
    ASSERT_EQ(argand(render + "--frames 0:3 -o f%d.exr", on_host).exit_code, 0);
    ASSERT_EQ(argand(render + "--at 0.0833333333333333333 -o at.exr", on_host).exit_code, 0);
    EXPECT_EQ(pixels("f2.exr"), pixels("at.exr"));
    EXPECT_NE(pixels("f0.exr"), pixels("f2.exr"));
}

TEST_F(ViewCommand, RefusesBadInput) {
    write("good.json", R"({"frames": 1})");
    write("none.json", R"({"frames": 0})");
    write("broken.json", R"({"frames": 1)");
    write("unknown.json", R"({"frames": 1, "events": [{"frame": 0, "zoom": 1}]})");
    write("folder.json",
          R"({"frames": 1, "events": [{"frame": 0, "screenshot": "no/such/a.png"}]})");
    write("format.json", R"({"frames": 1, "events": [{"frame": 0, "screenshot": "a.gif"}]})");
    write("itself.json", R"({"frames": 1, "events": [{"frame": 0, "save_edits": "itself.json"}]})");
    write("edits.json", R"({"lamps": {}})");
    write("deep.json",
          R"({"frames": )" + std::string(100'000, '[') + std::string(100'000, ']') + "}");
    expect_failure(view("--script deep.json"), failure, "64 levels", on_host);
    expect_failure(view(""), usage, "--script");
    expect_failure(view("--script missing.json"), failure, "missing.json", on_host);
    expect_failure(view("--script none.json"), failure, "at least 1", on_host);
    expect_failure(view("--script broken.json"), failure, "it is no JSON", on_host);
    expect_failure(view("--script unknown.json"), failure, "'zoom'", on_host);
    expect_failure(view("--script folder.json"), failure, "no/such", on_host);
    expect_failure(view("--script format.json"), usage, "a.gif", on_host);
    expect_failure(view("--script itself.json"), usage, "itself.json", on_host);
    expect_failure(view("--script good.json --frame-time 0"), usage, "--frame-time", on_host);
    expect_failure(view("--script good.json --edits edits.json"), failure, "'lamps'", on_host);
    expect_failure("render '" + asset("cornell_point.glb") + "' --edits edits.json -o a.png",
                   failure, "'lamps'", on_host);
    expect_failure("render '" + asset("cornell_point.glb") + "' --edits edits.json -o edits.json",
                   usage, "edits.json", on_host);
}

TEST_F(ViewCommand, SaysWhereAScriptFails) {
    write("script.json", R"({"frames": 3, "events": [
        {"frame": 1, "open": "/nowhere.glb", "screenshot": "shown.png"}]})");
    const Outcome run = argand(view("-q --script script.json --json frames.json"), on_host);
    EXPECT_EQ(run.exit_code, failure);
    EXPECT_THAT(run.error, HasSubstr("at frame 1, "));
    EXPECT_THAT(run.error, HasSubstr("/nowhere.glb"));
    const std::string frames = read_text(file("frames.json"));
    EXPECT_EQ(std::count(frames.begin(), frames.end(), '\n'), 2);
}

} // namespace
} // namespace argand::testing
