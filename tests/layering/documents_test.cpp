// The documents refer to files and sections that exist, and the lists in them are complete.
#include "support/scratch_directory.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>
#include <set>

namespace argand {
namespace {

using ::testing::IsEmpty;
using testing::read_text;
namespace fs = std::filesystem;

const fs::path root = ARGAND_SOURCE_DIR;

/// Files with one of these extensions, sorted, below the folders that hold text of this project.
std::set<fs::path> files_with(const std::set<std::string>& extensions) {
    std::set<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
        if (entry.is_regular_file() && extensions.contains(entry.path().extension())) {
            found.insert(entry.path());
        }
    }
    for (const std::string folder :
         {"assets", "docs", "engine", "examples", "shaders", "tests", "tools"}) {
        if (!fs::exists(root / folder)) {
            continue;
        }
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
            if (entry.is_regular_file() && extensions.contains(entry.path().extension())) {
                found.insert(entry.path());
            }
        }
    }
    return found;
}

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
    return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

/// The anchor that Markdown renderers give a heading: lower case, hyphens for spaces, no other
/// punctuation.
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80 || std::isalnum(byte) != 0 || c == '-' || c == '_') {
            anchor += static_cast<char>(byte >= 0x80 ? c : std::tolower(byte));
        } else if (c == ' ') {
            anchor += '-';
        }
    }
    return anchor;
}

std::set<std::string> anchors(const fs::path& page) {
    static const std::regex heading("(?:^|\n)#+ ([^\n]*)");
    const std::string text = read_text(page);
    std::set<std::string> found;
    for (const std::smatch& match : matches(text, heading)) {
        found.insert(anchor_of(match[1]));
    }
    return found;
}

/// Why a relative link from `page` leads nowhere; empty if it leads somewhere.
std::string fault(const fs::path& page, const std::string& link) {
    const std::size_t hash = link.find('#');
    const std::string path = link.substr(0, hash);
    const fs::path target = path.empty() ? page : page.parent_path() / path;
    if (!fs::exists(target)) {
        return page.lexically_relative(root).string() + ": no file " + link;
    }
    if (hash != std::string::npos && !anchors(target).contains(link.substr(hash + 1))) {
        return page.lexically_relative(root).string() + ": no section " + link;
    }
    return "";
}

std::vector<std::string> broken_links(const fs::path& page, const std::string& text) {
    static const std::regex link(R"(\]\(([^)\s]+)\))");
    std::vector<std::string> faults;
    for (const std::smatch& match : matches(text, link)) {
        const std::string to = match[1];
        if (to.find("://") == std::string::npos && !fault(page, to).empty()) {
            faults.push_back(fault(page, to));
        }
    }
    return faults;
}

TEST(Documents, BrokenLinksAreFound) {
    const fs::path page = root / "docs/design.md";
    EXPECT_EQ(broken_links(page, "[a](no_such.md)").size(), 1u);
    EXPECT_EQ(broken_links(page, "[a](design.md#no-such-section)").size(), 1u);
    EXPECT_EQ(broken_links(page, "[a](#no-such-section)").size(), 1u);
    EXPECT_THAT(broken_links(page, "[a](../README.md#two-commands) [b](#layout) [c](https://x.y)"),
                IsEmpty());
}

TEST(Documents, LinksLeadSomewhere) {
    std::vector<std::string> faults;
    for (const fs::path& page : files_with({".md"})) {
        for (const std::string& broken : broken_links(page, read_text(page))) {
            faults.push_back(broken);
        }
    }
    EXPECT_THAT(faults, IsEmpty());
}

TEST(Documents, PagesThatTheSourcesNameExist) {
    static const std::regex name(R"(docs/[\w/]+\.md)");
    std::vector<std::string> faults;
    for (const fs::path& file :
         files_with({".cpp", ".hpp", ".h", ".cu", ".comp", ".glsl", ".py", ".md", ""})) {
        const std::string text = read_text(file);
        for (const std::smatch& match : matches(text, name)) {
            if (!fs::exists(root / match.str())) {
                faults.push_back(file.lexically_relative(root).string() + ": " + match.str());
            }
        }
    }
    EXPECT_THAT(faults, IsEmpty());
}

// Names in capitals stand for any file of their kind (engine/methods/NAME.cpp).
TEST(Documents, SourcesThatThePagesNameExist) {
    static const std::regex name(
        R"((?:engine|shaders|tests|tools|assets|examples)/[\w/]+\.(?:cpp|hpp|h|cu|comp|glsl|py|glb|gltf)\b)");
    static const std::regex placeholder("/[A-Z]+");
    std::vector<std::string> faults;
    for (const fs::path& page : files_with({".md"})) {
        if (page == root / "docs/results/tree.md") {
            continue; // it compares with an earlier tree
        }
        const std::string text = read_text(page);
        for (const std::smatch& match : matches(text, name)) {
            const std::string named = match.str();
            if (!std::regex_search(named, placeholder) && !fs::exists(root / named)) {
                faults.push_back(page.lexically_relative(root).string() + ": " + named);
            }
        }
    }
    EXPECT_THAT(faults, IsEmpty());
}

TEST(Documents, TestsThatThePagesNameExist) {
    static const std::regex definition(R"(\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\))");
    static const std::regex name(R"(`(?:test_\w+: )?([A-Z]\w+\.[A-Z]\w+)`)");
    std::set<std::string> tests;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / "tests")) {
        if (entry.path().extension() != ".cpp") {
            continue;
        }
        const std::string text = read_text(entry.path());
        for (const std::smatch& match : matches(text, definition)) {
            tests.insert(match[1].str() + "." + match[2].str());
        }
    }
    ASSERT_TRUE(tests.contains("Documents.LinksLeadSomewhere"));
    std::vector<std::string> faults;
    for (const fs::path& page : files_with({".md"})) {
        const std::string text = read_text(page);
        for (const std::smatch& match : matches(text, name)) {
            if (!tests.contains(match[1])) {
                faults.push_back(page.lexically_relative(root).string() + ": " + match[1].str());
            }
        }
    }
    EXPECT_THAT(faults, IsEmpty());
}

TEST(Documents, TheDesignNamesEveryFolderOfTheEngineAndNoOther) {
    const std::string design = read_text(root / "docs/design.md");
    const std::string layout = design.substr(
        design.find("    engine/"), design.find("    shaders/comp/") - design.find("    engine/"));
    static const std::regex folder("\n      (\\w+)/ ");
    std::set<std::string> named;
    for (const std::smatch& match : matches(layout, folder)) {
        named.insert(match[1]);
    }
    std::set<std::string> present;
    for (const fs::directory_entry& entry : fs::directory_iterator(root / "engine")) {
        if (entry.is_directory()) {
            present.insert(entry.path().filename());
        }
    }
    EXPECT_EQ(named, present);
}

TEST(Documents, EveryMethodIsInTheTableAndDescribed) {
    static const std::regex entry(R"(\n +METHOD\((\w+)\))");
    static const std::regex definition(R"(\nMethodInfo (\w+)_method\(\) \{)");
    const std::string table = read_text(root / "engine/methods/table.cpp");
    std::set<std::string> entries;
    for (const std::smatch& match : matches(table, entry)) {
        entries.insert(match[1]);
    }
    std::set<std::string> defined;
    for (const fs::directory_entry& file : fs::directory_iterator(root / "engine/methods")) {
        const std::string text = read_text(file.path());
        for (const std::smatch& match : matches(text, definition)) {
            defined.insert(match[1]);
        }
    }
    EXPECT_TRUE(entries.contains("path"));
    EXPECT_EQ(entries, defined);
    const std::string page = read_text(root / "docs/photon-map.md");
    for (std::string method : entries) {
        std::replace(method.begin(), method.end(), '_', '-');
        EXPECT_NE(page.find("\n| `" + method + "`"), std::string::npos) << method;
    }
}

TEST(Documents, TheIndexOfResultsNamesEveryPage) {
    const std::string index = read_text(root / "docs/results/README.md");
    for (const fs::directory_entry& entry : fs::directory_iterator(root / "docs/results")) {
        const std::string name = entry.path().filename();
        if (entry.path().extension() == ".md" && name != "README.md") {
            EXPECT_NE(index.find("](" + name + ")"), std::string::npos) << name;
        }
    }
}

// As write_index() in tools/results_common.py finds them.
TEST(Documents, TheIndexOfResultsHasTheRevisionsOfThePages) {
    static const std::regex row(R"(\| \[[^\]]+\]\((\w+\.md)\) \| [^|]+ \| ([^|]+) \|)");
    static const std::regex revision(R"(revisions?\s+([0-9a-f]{7,12})\b)");
    const std::string index = read_text(root / "docs/results/README.md");
    const std::vector<std::smatch> rows = matches(index, row);
    ASSERT_GT(rows.size(), 10u);
    for (const std::smatch& match : rows) {
        const std::string page = read_text(root / "docs/results" / match[1].str());
        std::string revisions;
        for (const std::smatch& found : matches(page, revision)) {
            if (revisions.find(found[1].str()) == std::string::npos) {
                revisions += (revisions.empty() ? "" : ", ") + found[1].str();
            }
        }
        EXPECT_EQ(match[2], revisions.empty() ? "not recorded" : revisions)
            << match[1] << ": run write_index() of tools/results_common.py";
    }
}

} // namespace
} // namespace argand
