// What isolation writes for a tile where one work item has all sixteen lanes.
#define LEADS true

void enter_single(Work work, int place, Lanes root, Lanes slope, real start, real stop, bool whole, real lean_x,
                  real lean_y) {
    EACH_LANE {
        enter(work, place + OWN_LANE, NUMBER(root));
        enter(work, place + 16 + OWN_LANE, NUMBER(slope));
    }
    enter_piece(work, place + 32, start, stop, whole, lean_x, lean_y);
}
