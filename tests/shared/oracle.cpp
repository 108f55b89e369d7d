#define ARGAND_REAL_DOUBLE
#include "oracle.hpp"

#include "shared/bsdf.h"
#include "shared/camera.h"
#include "shared/lights.h"
#include "shared/photon.h"
#include "shared/surface.h"

#include <stdexcept>
#include <string_view>

namespace argand::truth {

using namespace argand::oracle;

namespace {

template <class T> T as(const std::array<std::byte, sizeof(T)>& record) {
    return std::bit_cast<T>(record);
}

} // namespace

glm::dvec3 bsdf_eval(const MaterialBytes& material, glm::dvec3 wo, glm::dvec3 wi, unsigned lobes) {
    return oracle::bsdf_eval(as<MaterialRecord>(material), wo, wi, lobes);
}

double bsdf_pdf(const MaterialBytes& material, glm::dvec3 wo, glm::dvec3 wi, unsigned lobes) {
    return oracle::bsdf_pdf(as<MaterialRecord>(material), wo, wi, lobes);
}

glm::dvec3 rough_clear_eval_and_pdf(const MaterialBytes& material, glm::dvec3 wo, glm::dvec3 wi,
                                    bool front, double& pdf) {
    return oracle::rough_clear_eval_and_pdf(as<MaterialRecord>(material), wo, wi, front, pdf);
}

BsdfSample bsdf_sample(const MaterialBytes& material, glm::dvec3 wo, bool front, unsigned lobes,
                       glm::dvec4 u) {
    oracle::BsdfSample s;
    const bool scattered =
        oracle::bsdf_sample(as<MaterialRecord>(material), wo, front, lobes, u, s);
    return {scattered, s.wi, s.weight, s.pdf, s.eta_scale, s.lobe};
}

LightSample light_sample(const Record& light, glm::dvec3 p, glm::dvec2 u) {
    oracle::LightSample s;
    const bool lit = oracle::light_sample(as<LightRecord>(light), oracle::all_light_kinds, p, u, s);
    return {lit, s.wi, s.radiance, s.distance, s.pdf};
}

glm::dvec3 light_power(const Record& light, double radius) {
    return oracle::light_power(as<LightRecord>(light), oracle::all_light_kinds, radius);
}

Emission light_emit(const Record& light, glm::dvec4 u, glm::dvec4 v, glm::dvec3 center,
                    double radius) {
    oracle::EmittedPhoton p;
    oracle::light_emit(as<LightRecord>(light), oracle::all_light_kinds, {center, radius}, u, v, p);
    return {p.origin, p.direction, p.flux};
}

Ray camera_ray(const Record& camera, double x, double y, glm::dvec2 u) {
    Ray ray;
    oracle::camera_ray(as<CameraRecord>(camera), x, y, u, ray.origin, ray.direction);
    return ray;
}

Surface make_surface(const std::array<glm::dvec3, 3>& p, const std::array<glm::dvec3, 3>& n,
                     double u, double v, glm::dvec3 ray_direction) {
    const oracle::Surface s =
        oracle::make_surface({p[0], p[1], p[2], n[0], n[1], n[2]}, u, v, ray_direction);
    return {s.position, s.geometric_normal, s.shading_normal, s.front};
}

unsigned pack_photon_normal(glm::dvec3 normal, bool caustic) {
    return oracle::pack_photon_normal(normal, caustic);
}

glm::dvec3 unpack_photon_normal(unsigned packed) { return oracle::unpack_photon_normal(packed); }

double kernel_weight(double squared_distance) { return oracle::kernel_weight(squared_distance); }

double elementary(const char* name, double x, double y) {
    const std::string_view f = name;
    double s = 0;
    double c = 0;
    if (f == "sin_2pi" || f == "cos_2pi") {
        sincos_2pi(x, s, c);
        return f == "sin_2pi" ? s : c;
    }
    if (f == "pow") {
        return pow_real(x, y);
    }
    throw std::invalid_argument(name);
}

} // namespace argand::truth
