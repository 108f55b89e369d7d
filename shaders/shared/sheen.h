// KHR_materials_sheen: light that fibres standing on the surface scatter at grazing angles (Conty
// Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF"), in a frame whose z is the
// surface's normal, for directions above the surface.
//
// The model gains light where it is smoother than about 0.25: up to 2.1 times what arrives. There
// it is divided by the greater of its albedos for both directions, which keeps it reciprocal.
#ifndef ARGAND_SHARED_SHEEN_H
#define ARGAND_SHARED_SHEEN_H

#include "shared/ggx_energy.h"

ARGAND_SHARED_BEGIN

// Smoother sheen is rendered with this roughness squared: its fibres would be needles.
CONSTANT real SMALLEST_SHEEN_ALPHA = real(0.01);

// Logarithm of Smith's lambda for cosines up to 0.5, as fitted by the paper. Its differences of
// parameters are written out: compilers of GLSL and C++ do not round them alike.
FN real sheen_log_lambda(real cosine, real alpha) {
    real t = (real(1.0) - alpha) * (real(1.0) - alpha);
    real a = real(21.5473) + real(3.7772) * t;
    real b = real(3.82987) - real(0.50552) * t;
    real c = real(0.19823) - real(0.03022) * t;
    real d = real(-1.97760) + real(0.70367) * t;
    real e = real(-4.32054) - real(0.53913) * t;
    return a / (real(1.0) + b * pow_real(cosine, c)) + d * cosine + e;
}

FN real sheen_lambda(real cosine, real alpha) {
    real l = cosine < real(0.5) ? sheen_log_lambda(cosine, alpha)
                                : real(2.0) * sheen_log_lambda(real(0.5), alpha) -
                                      sheen_log_lambda(max(real(1.0) - cosine, real(0.0)), alpha);
    return l > real(0.0) ? real(1.0) / exp_negative(-l) : exp_negative(l);
}

// Share of light from this cosine that sheen of colour 1 scatters, a least-squares fit to
// quadratures in double precision; the tests repeat them. Within 0.004 of the greater of it and 1,
// for cosines from 0.004.
FN real sheen_albedo(real alpha, real cosine) {
    real u = real(2.0) * sqrt(clamp(cosine, real(0.004), real(1.0))) - real(1.0);
    // From the roughness's root, 0.1 to 1.
    real least = real(0.31622777);
    real s = real(2.0) * (sqrt(sqrt(alpha)) - least) / (real(1.0) - least) - real(1.0);
    real c0 = quintic(s, vec3(real(0.3380), real(0.1961), real(0.0540)),
                      vec3(real(0.1059), real(-0.0901), real(-0.0693)));
    real c1 = quintic(s, vec3(real(-0.5238), real(0.1834), real(-0.3369)),
                      vec3(real(0.0191), real(0.3660), real(-0.1917)));
    real c2 = quintic(s, vec3(real(0.1266), real(-0.1939), real(0.7328)),
                      vec3(real(-1.1199), real(-0.1637), real(0.6983)));
    real c3 = quintic(s, vec3(real(0.1273), real(-0.0739), real(0.1033)),
                      vec3(real(0.1829), real(-0.9694), real(0.7168)));
    real c4 = quintic(s, vec3(real(0.2552), real(-0.2843), real(-0.5632)),
                      vec3(real(1.8118), real(0.8615), real(-1.8659)));
    real c5 = quintic(s, vec3(real(-0.3223), real(0.1528), real(-0.0018)),
                      vec3(real(-0.2571), real(0.3408), real(-0.1916)));
    real c6 = quintic(s, vec3(real(-0.3662), real(0.2276), real(0.1059)),
                      vec3(real(-0.8566), real(-0.5214), real(1.0554)));
    real c7 = quintic(s, vec3(real(0.3818), real(-0.1372), real(0.0212)),
                      vec3(real(0.1552), real(0.1283), real(-0.1832)));
    return max(c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * (c5 + u * (c6 + u * c7)))))),
               real(0.0));
}

// Value of sheen of colour 1, without the cosine [1/sr]. albedo: the greater of those at wo and wi.
FN real sheen_value(real alpha, vec3 wo, vec3 wi, real albedo) {
    vec3 h = wo + wi;
    real h2 = dot3(h, h);
    real sine2 = min((h.x * h.x + h.y * h.y) / h2, real(1.0));
    real inverse = real(1.0) / alpha;
    real distribution =
        (real(2.0) + inverse) * real(0.5) * INV_PI * pow_real(sine2, real(0.5) * inverse);
    real masked = real(1.0) + (sheen_lambda(wo.z, alpha) + sheen_lambda(wi.z, alpha));
    return distribution / (masked * real(4.0) * (wo.z * wi.z) * max(albedo, real(1.0)));
}

ARGAND_SHARED_END

#endif
