#pragma once

#include "scene/camera.hpp"
#include "scene/environment.hpp"
#include "scene/light.hpp"
#include "scene/motion.hpp"
#include "scene/texture.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace argand {

/// Modified Phong BRDF (Lafortune and Willems 1994): base_color/π + specular (n + 2)/(2π) cosⁿ.
struct Phong {
    glm::vec3 specular{0}; ///< at most 1 in each channel together with base_color
    float exponent = 0;    ///< n >= 0
};

/// A surface in glTF's terms: metallic-roughness and the extensions named beside the fields.
struct Material {
    std::string name;
    glm::vec3 base_color{1};
    float metallic = 1;
    float roughness = 1;
    float specular = 1;          ///< KHR_materials_specular; 0 makes a dielectric purely Lambertian
    glm::vec3 specular_color{1}; ///< KHR_materials_specular
    glm::vec3 emission{0}; ///< radiance [cd/m²], KHR_materials_emissive_strength and alpha included
    float coverage = 1; ///< alpha: the share of the surface that is present; the rest passes light
    float transmission = 0;  ///< KHR_materials_transmission
    float ior = 1.5f;        ///< KHR_materials_ior
    float thickness = 0;     ///< KHR_materials_volume; 0: thin wall, else a refracting solid
    glm::vec3 absorption{0}; ///< KHR_materials_volume: inside a solid [1/length]
    float coat = 0;          ///< KHR_materials_clearcoat: share of the surface
    float coat_roughness = 0;
    bool coat_has_normal = false; ///< of its own, as a texture turns the surface's or the coat's
    float dispersion = 0;         ///< KHR_materials_dispersion: of a solid, 20 over Abbe's number
    float priority = 0;           ///< of a solid: where solids overlap, the greatest one is there
    float film = 0; ///< KHR_materials_iridescence: share of the surface with a thin film
    float film_ior = 1.3f;
    float film_thickness = 0.4f; ///< [micrometres]
    glm::vec3 sheen_color{0};    ///< KHR_materials_sheen
    float sheen_roughness = 0;
    /// KHR_materials_anisotropy: strength times cosine and sine of the rotation from the tangent.
    glm::vec2 anisotropy{0};
    bool unlit = false; ///< KHR_materials_unlit: shows its base colour, and scatters nothing
    bool double_sided = false;
    /// If present, replaces metal, dielectric, transmission, coat, film and sheen.
    std::optional<Phong> phong;
    /// Which textures it has: material_*_texture(s) of shared/texture_record.h. They follow one
    /// another in Scene::textures, in the order of these bits; the others are the last.
    std::uint32_t texture_bits = 0;
    std::uint32_t first_texture = 0;
    std::uint32_t texture_count = 0;
    bool alpha_varies = false; ///< with the texels or the vertices, and the mode is not opaque
    AlphaMode alpha_mode = AlphaMode::opaque; ///< how the alpha of texels and vertices acts
    float alpha_threshold = 0; ///< mask: the surface is absent where their product is less
};

/// A node of the file that shows triangles: those from its first one to that of the next object.
struct SceneObject {
    std::uint32_t node = 0; ///< index in the file
    std::string name;
    std::uint32_t first_triangle = 0;
};

/// An animation of the file.
struct Animation {
    std::string name;
    double seconds = 0;             ///< time of its last key
    std::vector<std::string> moves; ///< "rotation of node 2 "wheel""
};

/// The order of the solids that light may pass (shared/solids.h).
struct SolidRanks {
    /// The material of each rank, lowest first: by priority, and of equal priority the larger
    /// volume first, so that an ice cube is in its water, and the water not in the ice.
    std::vector<std::uint32_t> materials;
    /// Of each material of the scene 1 more than its rank; 0: it bounds no solid. A body that is
    /// turned inside out is a cavity, of the solid of the same glass around it, whose rank it has.
    std::vector<std::uint32_t> of_material;
    /// Two solids whose bounding boxes overlap, not only touch; any two if meshes move.
    std::optional<std::pair<std::uint32_t, std::uint32_t>> overlapping;
};

struct Bounds {
    glm::vec3 low{std::numeric_limits<float>::infinity()};
    glm::vec3 high{-std::numeric_limits<float>::infinity()};
};

/// A file's contents on the host at one moment: triangles in world space, materials, lights,
/// cameras. move_to() changes the moment.
struct Scene {
    std::string name;                         ///< file name without directory
    std::vector<std::filesystem::path> files; ///< other ones that the file names: buffers, images
    std::vector<glm::vec3> positions;         ///< vertices, world space
    std::vector<glm::vec3> normals;   ///< one per vertex, unit; (0,0,0): use the geometric normal
    std::uint32_t uv_sets = 0;        ///< texture coordinates of each vertex
    std::vector<glm::vec2> uvs;       ///< uv_sets per vertex, finite
    std::vector<glm::u16vec4> colors; ///< one per vertex, 65535 is 1; empty: all are white
    /// One per vertex, or none: the tangents of the file, unit, and the sign of the bitangent; its
    /// sign is 0 where the file has none.
    std::vector<glm::vec4> vertex_tangents;
    /// Of each triangle the tangents at its corners (scene/tangents.hpp), if any surface has a
    /// normal texture.
    std::vector<glm::uvec3> tangents;
    std::vector<glm::uvec3> triangles; ///< vertex indices, counter-clockwise seen from the front
    std::vector<std::uint32_t> triangle_material; ///< one per triangle, index into materials
    std::vector<SceneObject> objects; ///< by first_triangle; those without triangles are left out
    std::vector<Material> materials;  ///< at least one
    /// At rest, so that they are the same at all times. Reset it after a change of materials or
    /// triangles; those of where solids are now take its place.
    std::optional<SolidRanks> solids;
    std::vector<Texture> textures;                           ///< a material's follow one another
    std::vector<std::shared_ptr<const TextureImage>> images; ///< used by textures
    std::vector<Light> lights;
    std::optional<glm::vec3> sky;           ///< uniform radiance from all directions [cd/m²]
    std::optional<Environment> environment; ///< a sky that is not uniform; unused if there is `sky`
    std::vector<Camera> cameras; ///< at least one after loading, added if the file has none
    std::vector<Animation> animations;
    std::optional<double> seconds;            ///< moment of the animations; none: at rest
    Motion motion;                            ///< what moves, in object space
    std::vector<std::string> extensions_used; ///< as the file lists them
    /// Seconds that the parts of loading took, by name.
    std::vector<std::pair<std::string, double>> load_seconds;
    std::vector<std::string>
        notes; ///< unsupported features and added objects, one line each, for the user
};

/// Bounding box of the vertices that triangles use; low > high if there are none.
Bounds bounds(const Scene& scene);

/// Time of the last key of all animations; 0 if there are none.
double longest_animation(const Scene& scene);

/// Area of a triangle, in double precision.
double area(const Scene& scene, std::size_t triangle);

/// Sum of the areas of all triangles, in double precision.
double surface_area(const Scene& scene);

/// Roughness in glTF's terms that matches the width of a Phong lobe: GGX's alpha² = 2/(n + 2).
float roughness_of_phong(float exponent);

/// Whether triangles of this material emit light.
bool emits(const Material& material);

} // namespace argand
