// What a method answers for one ray: where, what, and how many evaluations of f it spent.
STRUCT(Hit) struct Hit { real t; int status; int evaluations; };

#define MISS 0
#define HIT 1
#define EXHAUSTED 2
#define MOST_EVALUATIONS 16777215  // of one ray, 2^24 - 1: more is no count
#define NO_ANSWER (-1)  // the word in place of an answer that cannot be one

Hit no_hit(real t) {
    Hit hit;
    hit.t = t;
    hit.status = MISS;
    hit.evaluations = 0;
    return hit;
}

Hit hit_at(Hit hit, real t) {
    hit.t = t;
    hit.status = HIT;
    return hit;
}

Hit missed(Hit hit) {
    hit.status = MISS;
    return hit;
}

// Whether the status is one of MISS to EXHAUSTED and the count lies in 0 to MOST_EVALUATIONS.
bool is_answer(int status, int evaluations) {
    return ((status & -4) | (evaluations & ~MOST_EVALUATIONS)) == 0 && status <= EXHAUSTED;
}

// Gave up inside its budget at t; never a miss.
Hit exhausted(Hit hit, real t) {
    hit.t = t;
    hit.status = EXHAUSTED;
    return hit;
}
