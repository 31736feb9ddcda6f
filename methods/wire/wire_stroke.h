#pragma once

#include "methods/wire/wire_edge.h"
#include "methods/wire/wire_profile.h"

// Lines of the wireframe methods vary along an edge and with depth.

namespace burin {

/// How the lines of the wireframe methods look: a profile, and what varies it along an edge and
/// with depth. Dashes, squeezed and dual strokes after Baerentzen et al. 2006 and 2008, dots after
/// Gateau 2007.
class WireStroke {
  public:
    /// `width_px` is the full width asked for. `profile` and `core_px` are the method's own, for
    /// settings that name none; `cut` see WireProfile.
    WireStroke(const WireSettings& settings, double width_px, WireProfileKind profile, double core_px,
               double cut = WireProfile::kNoCut);

    /// Beyond this distance from an edge nothing is drawn. Pixels.
    double reach_px() const { return reach_px_; }

    /// Darkness from 0 to 1 at a pixel that lies `distance` pixels from the edge, its foot `along`
    /// pixels from the edge's start. `z` is the depth from 0 to 1 (see DepthRange).
    double intensity(const WireEdge& edge, double distance, double along, double z) const;
    /// Darkness of a line that is drawn as dots (for diagonals).
    double dots(double distance, double along) const;

    const WireProfile& profile() const { return profile_; }

  private:
    WireProfile thinned(double share, double part) const;
    double dash(const WireEdge& edge, double along, double length) const;

    const WireSettings& settings_;
    double width_px_;
    WireProfile profile_, dot_profile_;
    double reach_px_;
    bool is_plain_;  // the profile is all there is
};

/// How much of their width lines keep at a depth.
double thinning_factor(WireThinning thinning, double z);

/// The part of the interval of length `spread` around x (both in periods) in which dashes are on.
double dash_coverage(double x, double spread, double duty);

}  // namespace burin
