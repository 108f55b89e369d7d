#include "gltf_builder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argand {
namespace {

using namespace testing_gltf;
using ::testing::HasSubstr;

std::string problem_of(const std::filesystem::path& path) {
    try {
        load_gltf(path);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// The triangle as a .gltf whose buffer is at `uri`.
std::string text_of_triangle(const std::string& uri) {
    GltfBuilder builder = one_triangle();
    builder.root["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", uri}}};
    return builder.root.dump();
}

struct GltfFile : ::testing::Test {
    TempDirectory directory;
    Bytes triangle = one_triangle().binary;
};

TEST_F(GltfFile, ReadsExternalBuffers) {
    directory.write("parts/the buffer+1.bin", triangle);
    const auto file = directory.write("scene.gltf", text_of_triangle("parts/the%20buffer+1.bin"));
    EXPECT_EQ(corners_of(load_gltf(file), 0), right_triangle());
}

TEST_F(GltfFile, ReadsBuffersLongerThanNeeded) {
    Bytes longer = triangle;
    longer.resize(longer.size() + 100, 7);
    directory.write("a.bin", longer);
    EXPECT_EQ(corners_of(load_gltf(directory.write("scene.gltf", text_of_triangle("a.bin"))), 0),
              right_triangle());
}

TEST_F(GltfFile, ReadsBase64) {
    // 36 bytes: three times three floats.
    const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    for (const char* type : {"application/octet-stream", "application/gltf-buffer"}) {
        const auto file = directory.write(
            "scene.gltf", text_of_triangle(std::string("data:") + type + ";base64," + base64));
        EXPECT_EQ(corners_of(load_gltf(file), 0), right_triangle());
    }
}

TEST_F(GltfFile, TellsTextFromBinaryByContent) {
    EXPECT_EQ(load_gltf(directory.write("misnamed.gltf", one_triangle().glb())).triangles.size(),
              1u);
    directory.write("a.bin", triangle);
    EXPECT_EQ(
        load_gltf(directory.write("misnamed.glb", text_of_triangle("a.bin"))).triangles.size(), 1u);
}

TEST_F(GltfFile, ReadsTextWithAByteOrderMark) {
    directory.write("a.bin", triangle);
    EXPECT_EQ(load_gltf(directory.write("scene.gltf", "\xef\xbb\xbf" + text_of_triangle("a.bin")))
                  .triangles.size(),
              1u);
}

TEST_F(GltfFile, ReadsPathsWithSpacesAndUnicode) {
    EXPECT_EQ(load_gltf(directory.write("ein Pfad ❤/scène.glb", one_triangle().glb())).name,
              "scène.glb");
}

TEST_F(GltfFile, ExplainsWhyAPathFails) {
    const std::string missing = problem_of(directory.path() / "missing.glb");
    EXPECT_THAT(missing, HasSubstr("missing.glb': there is no such file"));
    EXPECT_THAT(problem_of(directory.path()), HasSubstr("it is a directory"));
    EXPECT_THAT(problem_of(directory.write("empty.glb", std::string())),
                HasSubstr("empty.glb': the file is empty"));
    EXPECT_THAT(problem_of("/dev/zero"), HasSubstr("not a regular file"));
}

TEST_F(GltfFile, ExplainsWhyABufferFails) {
    const auto problem = [&](const std::string& uri) {
        return problem_of(directory.write("scene.gltf", text_of_triangle(uri)));
    };
    EXPECT_THAT(problem("missing.bin"), HasSubstr("missing.bin': there is no such file"));
    directory.write("short.bin", Bytes(8, 0));
    EXPECT_THAT(problem("short.bin"), HasSubstr("'short.bin' has 8 bytes where 36 are required"));
    EXPECT_THAT(problem("."), HasSubstr("it is a directory"));
    EXPECT_THAT(problem("https://example.org/a.bin"), HasSubstr("neither a file nor base64 data"));
    EXPECT_THAT(problem("data:application/octet-stream;base64,AAAA"),
                HasSubstr("Failed to decode"));
    EXPECT_THAT(problem(""), HasSubstr("File not found"));
    GltfBuilder builder = one_triangle();
    builder.root["buffers"] = {{{"byteLength", 36}}};
    EXPECT_THAT(problem_of(directory.write("scene.gltf", builder.root.dump())),
                HasSubstr("buffer 0 has no uri"));
}

// A scene from elsewhere must not read what it was not given.
TEST_F(GltfFile, ReadsNothingOutsideItsFolderUnlessThatIsAllowed) {
    directory.write("outside/data.bin", triangle);
    directory.write("inside/data.bin", triangle);
    directory.write("insideout/data.bin", triangle);
    std::filesystem::create_symlink("../outside/data.bin", directory.path() / "inside/file");
    std::filesystem::create_directory_symlink("../outside", directory.path() / "inside/folder");
    std::filesystem::create_symlink("data.bin", directory.path() / "inside/near");
    const auto file = [&](const std::string& uri) {
        return directory.write("inside/scene.gltf", text_of_triangle(uri));
    };
    for (const std::string uri :
         {"../outside/data.bin", "%2e%2e/outside/data.bin", "..%2Foutside/data.bin", "file",
          "folder/data.bin", "../insideout/data.bin", "a/../../outside/data.bin"}) {
        const std::string problem = problem_of(file(uri));
        EXPECT_THAT(problem, HasSubstr("outside the scene's folder; --allow-external")) << uri;
        EXPECT_EQ(problem.find('\n'), std::string::npos);
    }
    for (const std::string uri : {"../outside/data.bin", "..%2Foutside/data.bin", "file"}) {
        EXPECT_EQ(load_gltf(file(uri), {}, {.allow_external = true}).triangles.size(), 1u) << uri;
    }
    const std::string absolute = (directory.path() / "outside/data.bin").string();
    EXPECT_THAT(problem_of(file(absolute)), HasSubstr("--allow-external"));
    EXPECT_EQ(load_gltf(file(absolute), {}, {.allow_external = true}).triangles.size(), 1u);
    for (const std::string uri : {"data.bin", "near", "../inside/data.bin", "./data.bin"}) {
        EXPECT_EQ(load_gltf(file(uri)).triangles.size(), 1u) << uri;
    }
    EXPECT_THAT(problem_of(file("/../../../../../../../../../dev/zero")),
                HasSubstr("--allow-external"));
    EXPECT_THAT(problem_of(file("data.bin%00")), HasSubstr("not the name of a file"));
}

TEST_F(GltfFile, DoesNotLookForBuffersInTheWorkingDirectory) {
    directory.write("elsewhere.bin", triangle);
    const auto file = directory.write("sub/scene.gltf", text_of_triangle("elsewhere.bin"));
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(directory.path());
    EXPECT_THAT(problem_of(file), HasSubstr("there is no such file"));
    std::filesystem::current_path(before);
}

TEST_F(GltfFile, NeedsNoImages) {
    GltfBuilder builder = one_triangle();
    directory.write("corrupt.png", std::string("this is no picture"));
    directory.write("empty.png", std::string());
    builder.root["images"] = {{{"uri", "missing.png"}},
                              {{"uri", "corrupt.png"}},
                              {{"uri", "empty.png"}},
                              {{"uri", "data:image/webp;base64,AAAA"}},
                              {{"uri", "data:image/png;base64,AAAA"}},
                              {{"bufferView", 0}, {"mimeType", "image/png"}}};
    builder.root["textures"] = {{{"source", 0}}};
    const Scene scene = load_gltf(directory.write("scene.glb", builder.glb()));
    EXPECT_EQ(scene.triangles.size(), 1u);
}

TEST_F(GltfFile, ReadsGlbsThatAreNotPadded) {
    // JSON and BIN chunks with lengths that are not multiples of four, followed by a chunk of an
    // unknown type.
    GltfBuilder builder = one_triangle();
    builder.root["buffers"] = {{{"byteLength", builder.binary.size()}}};
    Bytes glb = make_glb(builder.root.dump(), builder.binary);
    put_word(glb, 4);
    glb.insert(glb.end(), {'X', 'Y', 'Z', 'W', 1, 2, 3, 4});
    glb[8] = static_cast<std::uint8_t>(glb.size());
    glb[9] = static_cast<std::uint8_t>(glb.size() >> 8);
    EXPECT_EQ(load_gltf(directory.write("scene.glb", glb)).triangles.size(), 1u);
}

TEST_F(GltfFile, IgnoresBytesAfterAGlb) {
    Bytes glb = one_triangle().glb();
    glb.insert(glb.end(), 99, 0xee);
    EXPECT_EQ(load_gltf(directory.write("scene.glb", glb)).triangles.size(), 1u);
}

TEST_F(GltfFile, ExplainsWhyAGlbFails) {
    const auto problem = [&](const Bytes& bytes) {
        return problem_of(directory.write("scene.glb", bytes));
    };
    const Bytes good = one_triangle().glb();
    EXPECT_THAT(problem(Bytes(good.begin(), good.begin() + 9)),
                HasSubstr("truncated within the 12 bytes of its header"));
    EXPECT_THAT(problem(Bytes(good.begin(), good.end() - 1)),
                HasSubstr("the file is truncated: its header says"));
    Bytes bad = good;
    bad[4] = 1;
    EXPECT_THAT(problem(bad), HasSubstr("binary glTF of version 1"));
    bad = good;
    bad[15] = 0x7f; // length of the JSON chunk
    EXPECT_THAT(problem(bad), HasSubstr("chunk 0 of the binary glTF goes past the end"));
    bad = good;
    bad[16] = 'X';
    EXPECT_THAT(problem(bad), HasSubstr("first chunk of the binary glTF is not JSON"));
    bad.resize(12);
    bad[8] = 12;
    bad[9] = 0;
    EXPECT_THAT(problem(bad), HasSubstr("has no JSON chunk"));
    // A consistent length that truncates the BIN chunk.
    bad = good;
    bad.resize(bad.size() - 8);
    bad[8] = static_cast<std::uint8_t>(bad.size());
    bad[9] = static_cast<std::uint8_t>(bad.size() >> 8);
    EXPECT_THAT(problem(bad), HasSubstr("chunk 1 of the binary glTF goes past the end"));
}

TEST_F(GltfFile, ExplainsWhyJsonFails) {
    const auto problem = [&](const std::string& text) {
        return problem_of(directory.write("scene.gltf", text));
    };
    EXPECT_THAT(problem("{\"asset\": "), HasSubstr("its JSON is not valid: parse error at line 1"));
    EXPECT_THAT(problem("\x01\x02\x03"), HasSubstr("its JSON is not valid"));
    EXPECT_THAT(problem("[1, 2]"), HasSubstr("its JSON is not an object"));
    EXPECT_THAT(problem("{}"), HasSubstr("it is not glTF"));
    EXPECT_THAT(problem("{\"asset\": {\"version\": 2}}"), HasSubstr("it is glTF of version 2;"));
    EXPECT_THAT(problem("{\"asset\": {\"version\": \"1.0\"}}"),
                HasSubstr("it is glTF of version \"1.0\""));
    EXPECT_THAT(problem("{\"asset\": {\"version\": \"2.1\", \"minVersion\": \"2.1\"}}"),
                HasSubstr("version \"2.1\""));
    EXPECT_THAT(problem("{\"asset\": {\"version\": \"2.0\"}}"), HasSubstr("nothing to render"));
    EXPECT_THAT(problem("{\"asset\": {\"version\": \"2.0\"}, \"nodes\": 1e999}"),
                HasSubstr("its JSON is not valid"));
    EXPECT_THAT(problem("{\"asset\": {\"version\": \"2.0\"}, \"x\": \"\xff\"}"),
                HasSubstr("its JSON is not valid"));
}

TEST_F(GltfFile, RejectsDeepNestingInsteadOfOverflowingTheStack) {
    const std::size_t depth = 1000000;
    const std::string nested =
        "{\"asset\": {\"version\": \"2.0\"}, \"extras\": " + std::string(depth, '[') +
        std::string(depth, ']') + "}";
    EXPECT_THAT(problem_of(directory.write("scene.gltf", nested)), HasSubstr("nested more than"));
}

TEST_F(GltfFile, MessagesAreOneLine) {
    GltfBuilder builder = one_triangle();
    builder.root["meshes"][0]["name"] = "two\nlines\x1b[31m";
    builder.root["meshes"][0]["primitives"][0]["material"] = 5;
    const std::string problem = builder.problem();
    EXPECT_THAT(problem, HasSubstr("mesh 0 \"two lines [31m\" refers to material 5"));
    const std::string path = problem_of(directory.path() / "line\nbreak.glb");
    EXPECT_EQ(path.find('\n'), std::string::npos);
}

TEST_F(GltfFile, NotesTheParsersWarnings) {
    GltfBuilder builder = one_triangle();
    builder.root["meshes"][0]["primitives"].push_back({{"mode", 4}}); // no attributes
    EXPECT_TRUE(has_note(builder.load(), "not quite valid glTF: 'attributes' property is missing"));
}

} // namespace
} // namespace argand
