// A method is one row of a table: the command line, the report and the sweep know one that only
// this test has.
#include "argand_run.hpp"
#include "command_line.hpp"
#include "image/files.hpp"
#include "methods/method.hpp"

#include <array>
#include <sstream>

namespace argand::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Option echoes_option() {
    Option option = own_option("echoes", "Number of echoes", OptionKind::integer, "3");
    option.low = 1;
    option.high = 100;
    option.sweep = {.quick = {"1", "9"}, .full = {"1", "9"}};
    return option;
}

/// Renders as `path` does.
class Echo : public Method {
public:
    explicit Echo(RenderContext& context)
        : settings_(context.settings), path_(builtin_methods().at("path").make(context)) {}

    bool pass(const Pass& pass, const OnProgress& on_part) override {
        ++passes_;
        return path_->pass(pass, on_part);
    }
    std::uint64_t passes_per_seed() const override { return path_->passes_per_seed(); }
    void persist(Archive& archive) override {
        path_->persist(archive);
        archive.value(passes_);
    }
    void report(RenderStatistics& statistics) const override {
        statistics.own["echoes_heard"] = passes_ * own_number(settings_, echoes_option());
    }

private:
    const RenderSettings& settings_;
    std::unique_ptr<Method> path_;
    int passes_ = 0;
};

MethodTable with_echo() {
    static const std::array methods{
        MethodInfo{.name = "echo",
                   .summary = "a method of this test",
                   .paper = "none",
                   .options = {builtin_methods().at("path").options.front(), echoes_option()},
                   .make = [](RenderContext& context) -> std::unique_ptr<Method> {
                       return std::make_unique<Echo>(context);
                   }},
        builtin_methods().at("photons"), builtin_methods().at("path")};
    return MethodTable(methods);
}

class AddedMethod : public ArgandTest {
protected:
    /// Runs the command line in this process; arguments are separated by spaces.
    static Outcome run(const std::string& arguments) {
        std::istringstream words("argand " + arguments);
        std::vector<std::string> texts;
        for (std::string word; words >> word;) {
            texts.push_back(word);
        }
        std::vector<const char*> argv;
        for (const std::string& text : texts) {
            argv.push_back(text.c_str());
        }
        ::testing::internal::CaptureStdout();
        ::testing::internal::CaptureStderr();
        Outcome outcome;
        outcome.exit_code =
            run_command_line(static_cast<int>(argv.size()), argv.data(), with_echo());
        outcome.out = ::testing::internal::GetCapturedStdout();
        outcome.error = ::testing::internal::GetCapturedStderr();
        return outcome;
    }
};

TEST_F(AddedMethod, IsInTheHelp) {
    const Outcome help = run("render --help");
    EXPECT_EQ(help.exit_code, 0) << help.error;
    EXPECT_THAT(help.out, HasSubstr("echo, photons, path"));
    EXPECT_THAT(help.out, HasSubstr("a method of this test (none)"));
    EXPECT_THAT(help.out, HasSubstr("Method echo"));
    EXPECT_THAT(help.out, HasSubstr("--echoes UINT:from 1 to 100=3"));
    EXPECT_THAT(help.out, Not(HasSubstr("--flatness")));
    EXPECT_THAT(run("compare-backends --help").out, HasSubstr("echo,photons,path"));
    EXPECT_THAT(run("tradeoff --help").out, HasSubstr("echo,photons,path"));
}

TEST_F(AddedMethod, RendersAndReports) {
    const std::string scene = "render " + asset("cornell_area.glb") + " -q --backend cpu ";
    const std::string small = "--size 6x4 --spp 2 ";
    const Outcome echo = run(scene + small + "--method echo --echoes 5 -o " + file("echo.exr") +
                             " --json " + file("echo.json"));
    ASSERT_EQ(echo.exit_code, 0) << echo.error;
    const nlohmann::json report = nlohmann::json::parse(read_text(file("echo.json")));
    EXPECT_EQ(report.at("parameters").at("method"), "echo");
    EXPECT_EQ(report.at("parameters").at("echoes"), 5);
    EXPECT_EQ(report.at("echoes_heard"), 5);
    ASSERT_EQ(run(scene + small + "--method path -o " + file("path.exr")).exit_code, 0);
    const std::vector<Layer> a = read_image(file("echo.exr")), b = read_image(file("path.exr"));
    EXPECT_EQ(a.front().image.pixels, b.front().image.pixels);
}

TEST_F(AddedMethod, HasItsOptionToItself) {
    const std::string scene = "render " + asset("cornell_area.glb") + " --method ";
    const Outcome path = run(scene + "path --echoes 5");
    EXPECT_EQ(path.exit_code, 2);
    EXPECT_THAT(path.error, HasSubstr("--echoes: it has no effect with --method path; it is for "
                                      "echo"));
    const Outcome echo = run(scene + "echo --photons 5");
    EXPECT_EQ(echo.exit_code, 2);
    EXPECT_THAT(echo.error, HasSubstr("it is for photons"));
    const Outcome many = run(scene + "echo --echoes 101");
    EXPECT_EQ(many.exit_code, 2);
    EXPECT_THAT(many.error, HasSubstr("'101' is not an integer from 1 to 100"));
}

TEST_F(AddedMethod, IsSwept) {
    const Outcome swept = run("tradeoff " + asset("cornell_area.glb") + " -o " + file("sweep") +
                              " --quick --methods echo --size 6x4 --seeds 1 --backend cpu "
                              "--reference-seconds 0 -q");
    ASSERT_EQ(swept.exit_code, 0) << swept.error;
    const std::string csv = read_text(file("sweep/tradeoff.csv"));
    for (const char* row : {"echo,default,", "echo,spp,32,", "echo,echoes,1,", "echo,echoes,9,"}) {
        EXPECT_THAT(csv, HasSubstr(row));
    }
    EXPECT_THAT(csv, HasSubstr("--method echo --echoes 9"));
}

TEST_F(AddedMethod, IsInspected) {
    // The table's first method is that of scenes with caustics.
    const Outcome inspected = run("inspect " + asset("cornell_glass.glb"));
    EXPECT_EQ(inspected.exit_code, 0) << inspected.error;
    EXPECT_THAT(inspected.out, HasSubstr("echo (default)"));
}

} // namespace
} // namespace argand::testing
