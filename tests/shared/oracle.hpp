#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <glm/glm.hpp>

/// The shared maths compiled in double precision, behind plain types, because a source file can
/// include only one of both precisions.
namespace argand::truth {

/// The bytes of a LightRecord or CameraRecord.
using Record = std::array<std::byte, 64>;
/// The bytes of a MaterialRecord.
using MaterialBytes = std::array<std::byte, 160>;

glm::dvec3 bsdf_eval(const MaterialBytes& material, glm::dvec3 wo, glm::dvec3 wi, unsigned lobes);
double bsdf_pdf(const MaterialBytes& material, glm::dvec3 wo, glm::dvec3 wi, unsigned lobes);

/// Value and density of the clear lobe of rough glass.
glm::dvec3 rough_clear_eval_and_pdf(const MaterialBytes& material, glm::dvec3 wo, glm::dvec3 wi,
                                    bool front, double& pdf);

struct BsdfSample {
    bool scattered;
    glm::dvec3 wi, weight;
    double pdf, eta_scale;
    unsigned lobe;
};
BsdfSample bsdf_sample(const MaterialBytes& material, glm::dvec3 wo, bool front, unsigned lobes,
                       glm::dvec4 u);

struct LightSample {
    bool lit;
    glm::dvec3 wi, radiance;
    double distance, pdf;
};
LightSample light_sample(const Record& light, glm::dvec3 p, glm::dvec2 u);
glm::dvec3 light_power(const Record& light, double radius);

struct Emission {
    glm::dvec3 origin, direction, flux;
};
Emission light_emit(const Record& light, glm::dvec4 u, glm::dvec4 v, glm::dvec3 center,
                    double radius);

struct Ray {
    glm::dvec3 origin, direction;
};
Ray camera_ray(const Record& camera, double x, double y, glm::dvec2 u = {});

struct Surface {
    glm::dvec3 position, geometric_normal, shading_normal;
    bool front;
};
Surface make_surface(const std::array<glm::dvec3, 3>& vertices,
                     const std::array<glm::dvec3, 3>& normals, double u, double v,
                     glm::dvec3 ray_direction);

unsigned pack_photon_normal(glm::dvec3 normal, bool caustic);
glm::dvec3 unpack_photon_normal(unsigned packed);
double kernel_weight(double squared_distance);

/// Function by name: sin_2pi, cos_2pi, pow.
double elementary(const char* name, double x, double y = 0);

} // namespace argand::truth
