#pragma once

namespace burin {

/// A RowSink draws the rows of a picture from the top, as soon as the lines that reach them are found. Finding calls it
/// to say how far it has come, and does not know what draws.
class RowSink {
  public:
    virtual ~RowSink() = default;

    /// Draws the rows that lines from row `known_y` on do not reach: those above are in the drawing and will not
    /// change. Called by one thread of a pass, its number being `worker`, while the others find lines further down. It
    /// may leave rows for later. Returns the seconds that were spent on handing finished rows on.
    virtual double draw_rows_as(int worker, int known_y) = 0;
    /// Draws these rows while no pass runs, so that all threads may help, and no row is left for later. Returns seconds
    /// as above.
    virtual double draw_rows(int known_y) = 0;
    /// The first row of pixels whose pieces are still needed. Not to be called while other threads draw.
    virtual double first_needed_y() const = 0;
    /// Whether somebody waits for finished rows, so that finding must not run far ahead of them.
    virtual bool hands_on() const = 0;
};

}  // namespace burin
