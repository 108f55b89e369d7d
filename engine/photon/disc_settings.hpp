#pragma once

namespace argand {

/// Which photons count within a radius, and how much.
struct DiscSettings {
    bool uniform_kernel = false; ///< instead of Epanechnikov's
    /// All photons of a ball count, without a test of their surface and without correction where
    /// only a part of the disc lies on surfaces (Keller et al. 2010, section 1).
    bool ball = false;
};

} // namespace argand
