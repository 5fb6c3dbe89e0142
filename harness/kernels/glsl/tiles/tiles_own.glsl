// What isolation writes for a tile where one work item has all sixteen lanes.
#define LEADS true

void list_single(Work work, int cell, Lanes root, Lanes slope, real start, real stop, bool whole, int spent,
                 real lean_x, real lean_y) {
    int record = next_single(work, cell);
    EACH_LANE {
        enter(work, record + OWN_LANE, NUMBER(root));
        enter(work, record + 16 + OWN_LANE, NUMBER(slope));
    }
    enter_piece(work, record + 32, start, stop, whole, spent, lean_x, lean_y);
}
