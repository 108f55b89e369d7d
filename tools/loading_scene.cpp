// Writes a glTF file for tools/results_loading: 64 patches of 6,272 triangles each, and a texture
// of 1024 x 1024 pixels with noise in it for each patch, PNG and JPEG in turns.
//   loading_scene FILE.glb

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace {

constexpr int patches = 64, cells = 56, side = 1024;

std::uint32_t hashed(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352dU;
    x = (x ^ (x >> 15)) * 0x846ca68bU;
    return x ^ (x >> 16);
}

void append(void* to, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::uint8_t>*>(to);
    const auto* begin = static_cast<const std::uint8_t*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
}

/// Waves with noise of an eighth of the range.
std::vector<std::uint8_t> image_of(std::uint32_t patch) {
    std::vector<std::uint8_t> pixels;
    pixels.reserve(std::size_t{3} * side * side);
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const float x = static_cast<float>(i % side) / side,
                    y = static_cast<float>(i / side) / side;
        const std::uint32_t noise = hashed(i + patch * 0x9e3779b9U);
        for (unsigned c = 0; c < 3; ++c) {
            const float wave = std::sin(20 * x + 7 * y * static_cast<float>(c + 1)) * 90 + 112;
            pixels.push_back(static_cast<std::uint8_t>(wave) +
                             static_cast<std::uint8_t>((noise >> (8 * c)) & 31U));
        }
    }
    std::vector<std::uint8_t> bytes;
    if (patch % 2 == 0) {
        stbi_write_png_to_func(&append, &bytes, side, side, 3, pixels.data(), 0);
    } else {
        stbi_write_jpg_to_func(&append, &bytes, side, side, 3, pixels.data(), 90);
    }
    return bytes;
}

/// The binary chunk of the file and the lists of its JSON.
struct File {
    std::vector<std::uint8_t> binary;
    std::string views, accessors, meshes, materials, textures, images, nodes, roots;

    int add_view(const void* data, std::size_t size) {
        binary.resize((binary.size() + 3) / 4 * 4);
        views += (views.empty() ? "" : ",") + std::string(R"({"buffer":0,"byteOffset":)") +
                 std::to_string(binary.size()) + R"(,"byteLength":)" + std::to_string(size) + "}";
        const auto* bytes = static_cast<const std::uint8_t*>(data);
        binary.insert(binary.end(), bytes, bytes + size);
        return view_count++;
    }
    int add_accessor(int view, int type, const char* shape, std::size_t count,
                     const std::string& more = "") {
        accessors += (accessors.empty() ? "" : ",") + std::string(R"({"bufferView":)") +
                     std::to_string(view) + R"(,"componentType":)" + std::to_string(type) +
                     R"(,"type":")" + shape + R"(","count":)" + std::to_string(count) + more + "}";
        return accessor_count++;
    }
    int view_count = 0, accessor_count = 0;
};

void add_patch(File& file, int patch) {
    std::vector<float> positions, normals, uvs;
    std::vector<std::uint32_t> indices;
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            const float u = static_cast<float>(x) / cells, v = static_cast<float>(y) / cells;
            positions.insert(positions.end(), {u + 1.05f * static_cast<float>(patch % 8),
                                               v + 1.05f * static_cast<float>(patch / 8),
                                               0.05f * std::sin(9 * u) * std::sin(9 * v)});
            normals.insert(normals.end(), {0, 0, 1});
            uvs.insert(uvs.end(), {u, v});
            if (x > 0 && y > 0) {
                const auto i = static_cast<std::uint32_t>(y * (cells + 1) + x);
                const std::uint32_t row = cells + 1;
                indices.insert(indices.end(), {i - row - 1, i - row, i, i - row - 1, i, i - 1});
            }
        }
    }
    const auto view = [&](const auto& data) {
        return file.add_view(data.data(), data.size() * sizeof(data[0]));
    };
    const std::size_t count = positions.size() / 3;
    const int p = file.add_accessor(view(positions), 5126, "VEC3", count,
                                    R"(,"min":[-9,-9,-9],"max":[9,9,9])");
    const int n = file.add_accessor(view(normals), 5126, "VEC3", count);
    const int t = file.add_accessor(view(uvs), 5126, "VEC2", count);
    const int i = file.add_accessor(view(indices), 5125, "SCALAR", indices.size());
    const std::vector<std::uint8_t> image = image_of(static_cast<std::uint32_t>(patch));
    const std::string comma = patch > 0 ? "," : "", number = std::to_string(patch);
    file.images += comma + R"({"bufferView":)" + std::to_string(view(image)) +
                   R"(,"mimeType":"image/)" + (patch % 2 == 0 ? "png" : "jpeg") + R"("})";
    file.textures += comma + R"({"source":)" + number + "}";
    file.materials += comma + R"({"pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":)" +
                      R"({"index":)" + number + "}}}";
    file.meshes += comma + R"({"primitives":[{"material":)" + number + R"(,"indices":)" +
                   std::to_string(i) + R"(,"attributes":{"POSITION":)" + std::to_string(p) +
                   R"(,"NORMAL":)" + std::to_string(n) + R"(,"TEXCOORD_0":)" + std::to_string(t) +
                   "}}]}";
    file.nodes += comma + R"({"mesh":)" + number + "}";
    file.roots += comma + number;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: loading_scene FILE.glb\n", stderr);
        return 2;
    }
    File file;
    for (int patch = 0; patch < patches; ++patch) {
        add_patch(file, patch);
    }
    file.binary.resize((file.binary.size() + 3) / 4 * 4);
    std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + file.roots +
                       R"(]}],"nodes":[)" + file.nodes + R"(],"meshes":[)" + file.meshes +
                       R"(],"materials":[)" + file.materials + R"(],"textures":[)" + file.textures +
                       R"(],"images":[)" + file.images + R"(],"accessors":[)" + file.accessors +
                       R"(],"bufferViews":[)" + file.views + R"(],"buffers":[{"byteLength":)" +
                       std::to_string(file.binary.size()) + "}]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::ofstream out(argv[1], std::ios::binary);
    const auto put = [&](std::size_t word) {
        const auto value = static_cast<std::uint32_t>(word);
        out.write(reinterpret_cast<const char*>(&value), 4);
    };
    put(0x46546c67);
    put(2);
    put(12 + 8 + json.size() + 8 + file.binary.size());
    put(json.size());
    put(0x4e4f534a);
    out << json;
    put(file.binary.size());
    put(0x004e4942);
    out.write(reinterpret_cast<const char*>(file.binary.data()),
              static_cast<std::streamsize>(file.binary.size()));
    return out.good() ? 0 : 1;
}
