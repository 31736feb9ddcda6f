#pragma once

#include "render/frame.h"
#include "render/mattes.h"
#include "shading/ink/line_sides.h"

namespace burin {

/// LineOwners says which object and which material a piece of a line belongs to: those of the surface in front, of the
/// two beside it. May be used by several threads.
class LineOwners {
  public:
    explicit LineOwners(const Frame& frame) : sides_(frame.surfaces, frame.criteria.cos_crease_angle) {}

    MatteOwner of(const LinePiece& piece) const {
        const LineSides sides = sides_.sides_of(piece, false);
        return {sides.front_object, sides.front_material};
    }

  private:
    LineSidesFinder sides_;
};

}  // namespace burin
