// Subdivide on a cell of the image's quadtree (beamcasting, section III.C): runs BeamCast on the cell's beam from where
// the parent's search stopped. A cell that is not empty is handed to its four quarters. BeamCast stops at pieces that
// are half as deep at each further level (ε / 2). `path` is the way from the halved beam, which is 1, to a piece: a
// further binary digit for each halving in depth, 0 for the near half and 1 for the far half. With DESCENT 1 a cell
// hands down its path, and the whole beam is halved. With DESCENT 0 it hands down the depth w at which its piece
// begins, in steps of 1 / DEPTH_STEPS of the whole depth, and [w, far] is halved anew.
#define DEPTH_STEPS 8388608.0  // 2^23, so that float32 holds each step; step 1 is where the whole beam begins

void cast_cell(Work work, Cell cell) {
    Beam beam = cell_beam(work, cell);
    Hit hit = no_hit(beam.far);
    int deepest = cell.level + BISECTIONS;
    real whole = beam.far - beam.near;
    real epsilon = 1.4140625 * whole / real(1 << deepest);  // just below the square root of 2, see method.py
    int depth = cell.path == 1 || DESCENT == 0 ? 0 : deepest - 1;
    int path = DESCENT == 0 ? 1 : cell.path;
    if (DESCENT == 0) beam.near = beam.near + whole * (real(cell.path - 1) / DEPTH_STEPS);
    real width = (beam.far - beam.near) / real(1 << depth);
    bool searching = true;
    while (searching) {
        real s0 = path_depth(beam, path, width);
        real s1 = path_depth(beam, path + 1, width);
        Box box = beam_box(beam, s0, s1);
        bool empty = outside_domain(box);
        if (!empty) {
            Interval range = box_range(box);
            hit.evaluations += 1;
            empty = range.lo > 0.0 || range.hi < 0.0;
        }
        if (empty) {
            int up = trailing_zeros(path + 1);
            path = (path + 1) >> up;
            depth -= up;
            width *= real(1 << up);
            searching = path != 1;
        } else if (DESCENT == 0 ? width >= epsilon : depth < deepest) {
            path *= 2;
            depth += 1;
            width *= 0.5;
        } else {
            hit = hit_at(hit, 0.5 * (s0 + s1));
            searching = false;
        }
    }
    if (hit.status == MISS || cell.level == work.last) {
        paint(work, cell, hit);
        return;
    }
    if (DESCENT == 0) {
        real ahead = path_depth(beam, path, width) - work.camera.near;
        path = max(int(ahead / whole * DEPTH_STEPS), 1);
    }
    queue_cell(work, cell, path, hit, REMAP > 0 && hit.evaluations > REMAP);
}
