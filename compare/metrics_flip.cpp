#include "compare/metrics_flip.h"

#include <cmath>
#include <numbers>

#include "image/image_io.h"

namespace burin {
namespace {

constexpr double kPixelsPerDegree = 67.0206;
constexpr double kColorExponent = .7;                       // q_c
constexpr double kKnee = .4;                                // p_c: share of the largest difference ...
constexpr double kKneeValue = .95;                          // p_t: ... that is mapped to this value
constexpr double kFeatureWidthDeg = .082;                   // w
constexpr double kFeatureExponent = .5;                     // q_f
constexpr double kWhite[3] = {.950428545, 1, 1.088900371};  // D65

struct Vec3 {
    double x, y, z;
};

Vec3 xyz_from_linear(Vec3 c) {
    return {(10135552.0 * c.x + 8788810.0 * c.y + 4435075.0 * c.z) / 24577794.0,
            (2613072.0 * c.x + 8788810.0 * c.y + 887015.0 * c.z) / 12288897.0,
            (1425312.0 * c.x + 8788810.0 * c.y + 70074185.0 * c.z) / 73733382.0};
}

Vec3 linear_from_xyz(Vec3 c) {
    // The inverse of the matrix above.
    return {3.241003275 * c.x - 1.537398934 * c.y - 0.498615861 * c.z,
            -0.969224334 * c.x + 1.875930071 * c.y + 0.041554224 * c.z,
            0.055639423 * c.x - 0.204011202 * c.y + 1.057148933 * c.z};
}

/// CIELab with Hunt's effect: chroma counts less in the dark.
Vec3 hunt_lab(Vec3 xyz) {
    const auto f = [](double t) {
        constexpr double delta = 6.0 / 29.0;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29.0;
    };
    const double fx = f(xyz.x / kWhite[0]), fy = f(xyz.y / kWhite[1]), fz = f(xyz.z / kWhite[2]);
    const double lightness = 116 * fy - 16;
    return {lightness, .01 * lightness * 500 * (fx - fy), .01 * lightness * 200 * (fy - fz)};
}

double hyab(Vec3 a, Vec3 b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

Vec3 at(const ColorPlanes& p, std::size_t i) {
    return {static_cast<double>(p[0].values[i]), static_cast<double>(p[1].values[i]),
            static_cast<double>(p[2].values[i])};
}

void put(ColorPlanes& p, std::size_t i, Vec3 c) {
    p[0].values[i] = static_cast<float>(c.x);
    p[1].values[i] = static_cast<float>(c.y);
    p[2].values[i] = static_cast<float>(c.z);
}

/// sRGB to the opponent space YyCxCz.
ColorPlanes opponent(const ColorPlanes& srgb) {
    ColorPlanes result = srgb;
    for (std::size_t i = 0; i < srgb[0].values.size(); ++i) {
        const auto channel = [&](std::size_t c) { return static_cast<double>(linear_from_srgb(srgb[c].values[i])); };
        const Vec3 xyz = xyz_from_linear({channel(0), channel(1), channel(2)});
        const double x = xyz.x / kWhite[0], y = xyz.y / kWhite[1], z = xyz.z / kWhite[2];
        put(result, i, {116 * y - 16, 500 * (x - y), 200 * (y - z)});
    }
    return result;
}

/// A contrast sensitivity as a sum of two Gaussians, a sqrt(pi / b) exp(-pi^2 x^2 / b), x in
/// degrees.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivities[3] = {{1, .0047, 0, 1e-5}, {1, .0053, 0, 1e-5}, {34.1, .04, 13.5, .025}};

int sensitivity_radius() {
    return static_cast<int>(
        std::ceil(3 * std::sqrt(.04 / (2 * std::numbers::pi * std::numbers::pi)) * kPixelsPerDegree));
}

Plane filtered(const Plane& plane, const Sensitivity& s, int threads) {
    const int radius = sensitivity_radius();
    Plane result(plane.width, plane.height);
    const double terms[2][2] = {{s.a1, s.b1}, {s.a2, s.b2}};
    double weights[2], total = 0;
    std::vector<float> kernels[2];
    for (int k = 0; k < 2; ++k) {
        // exp(-pi^2 x^2 / b) is a Gaussian; a 2D Gaussian is the product of two 1D ones.
        double sum = 0;
        for (int i = -radius; i <= radius; ++i) {
            const double x = i / kPixelsPerDegree;
            sum += std::exp(-std::numbers::pi * std::numbers::pi * x * x / terms[k][1]);
        }
        const double sigma_px = std::sqrt(terms[k][1] / (2 * std::numbers::pi * std::numbers::pi)) * kPixelsPerDegree;
        kernels[k] = gaussian_kernel(sigma_px, radius);
        weights[k] = terms[k][0] * std::sqrt(std::numbers::pi / terms[k][1]) * sum * sum;
        total += weights[k];
    }
    for (int k = 0; k < 2; ++k) {
        if (weights[k] == 0) continue;
        const Plane part = convolve(plane, kernels[k], kernels[k], threads);
        const auto weight = static_cast<float>(weights[k] / total);
        for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] += weight * part.values[i];
    }
    return result;
}

/// What the eye sees of a picture, in Hunt-adjusted CIELab.
ColorPlanes seen(const ColorPlanes& yycxcz, int threads) {
    ColorPlanes result;
    for (std::size_t c = 0; c < 3; ++c) result[c] = filtered(yycxcz[c], kSensitivities[c], threads);
    for (std::size_t i = 0; i < result[0].values.size(); ++i) {
        const Vec3 o = at(result, i);
        const double y = (o.x + 16) / 116;
        const Vec3 rgb = linear_from_xyz({(y + o.y / 500) * kWhite[0], y * kWhite[1], (y - o.z / 200) * kWhite[2]});
        put(result, i,
            hunt_lab(xyz_from_linear(
                {std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0), std::clamp(rgb.z, 0.0, 1.0)})));
    }
    return result;
}

/// The largest colour difference there is: pure green against pure blue.
double largest_difference() {
    return std::pow(hyab(hunt_lab(xyz_from_linear({0, 1, 0})), hunt_lab(xyz_from_linear({0, 0, 1}))), kColorExponent);
}

Plane color_difference(const ColorPlanes& a, const ColorPlanes& b, int threads) {
    const ColorPlanes lab_a = seen(a, threads), lab_b = seen(b, threads);
    const double largest = largest_difference(), knee = kKnee * largest;
    Plane result(a[0].width, a[0].height);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const double d = std::pow(hyab(at(lab_a, i), at(lab_b, i)), kColorExponent);
        const double mapped =
            d < knee ? d * kKneeValue / knee : kKneeValue + (d - knee) / (largest - knee) * (1 - kKneeValue);
        result.values[i] = static_cast<float>(mapped);
    }
    return result;
}

/// How much of an edge and of a point each pixel is.
struct Features {
    Plane edges, points;
};

/// The positive and the negative values each get the sum 1 and -1.
std::vector<float> balanced(std::vector<double> kernel) {
    double positive = 0, negative = 0;
    for (const double k : kernel) (k > 0 ? positive : negative) += k;
    std::vector<float> result;
    for (const double k : kernel) result.push_back(static_cast<float>(k > 0 ? k / positive : -k / negative));
    return result;
}

Features features(const Plane& yy, int threads) {
    const double sd = .5 * kFeatureWidthDeg * kPixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * sd));
    const std::vector<float> blur = gaussian_kernel(sd, radius);
    std::vector<double> edge, point;
    for (int x = -radius; x <= radius; ++x) {
        const double g = std::exp(-x * x / (2 * sd * sd));
        edge.push_back(-x * g);
        point.push_back((x * x / (sd * sd) - 1) * g);
    }
    const std::vector<float> edge_kernel = balanced(edge), point_kernel = balanced(point);
    Plane lightness = yy;
    for (float& v : lightness.values) v = (v + 16) / 116;
    const auto strength = [&](const std::vector<float>& kernel) {
        Plane along_x = convolve(lightness, kernel, blur, threads);
        const Plane along_y = convolve(lightness, blur, kernel, threads);
        for (std::size_t i = 0; i < along_x.values.size(); ++i) {
            along_x.values[i] = std::hypot(along_x.values[i], along_y.values[i]);
        }
        return along_x;
    };
    return {strength(edge_kernel), strength(point_kernel)};
}

}  // namespace

Plane flip_color_difference(const ColorPlanes& result, const ColorPlanes& truth, int threads) {
    return color_difference(opponent(result), opponent(truth), threads);
}

FlipError flip_error(const ColorPlanes& result, const ColorPlanes& truth, int threads) {
    const ColorPlanes a = opponent(result), b = opponent(truth);
    FlipError error;
    error.map = color_difference(a, b, threads);
    const Features fa = features(a[0], threads), fb = features(b[0], threads);
    double sum = 0;
    for (std::size_t i = 0; i < error.map.values.size(); ++i) {
        const double edge = std::abs(static_cast<double>(fa.edges.values[i]) - static_cast<double>(fb.edges.values[i]));
        const double point =
            std::abs(static_cast<double>(fa.points.values[i]) - static_cast<double>(fb.points.values[i]));
        const double feature = std::pow(std::max(edge, point) / std::sqrt(2.0), kFeatureExponent);
        const double d = std::pow(static_cast<double>(error.map.values[i]), 1 - feature);
        error.map.values[i] = static_cast<float>(d);
        sum += d;
    }
    if (error.map.values.empty()) return error;
    error.mean = sum / static_cast<double>(error.map.values.size());
    std::vector<float> sorted = error.map.values;
    const std::size_t rank = (sorted.size() - 1) * 95 / 100;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank), sorted.end());
    error.p95 = static_cast<double>(sorted[rank]);
    return error;
}

}  // namespace burin
