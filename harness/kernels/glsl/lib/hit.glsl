// What a method answers for one ray: t, a status, and how many evaluations of f it spent.
STRUCT(Hit) struct Hit { real t; int status; int evaluations; };

#define MISS 0
#define HIT 1
#define EXHAUSTED 2
#define MOST_EVALUATIONS 16777215  // of one ray, 2^24 - 1: a larger count is invalid
#define NO_ANSWER (-1)  // the word that stands for an invalid answer

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

// Returns whether the status is MISS, HIT or EXHAUSTED and the count is from 0 to MOST_EVALUATIONS.
bool is_answer(int status, int evaluations) {
    return ((status & -4) | (evaluations & ~MOST_EVALUATIONS)) == 0 && status <= EXHAUSTED;
}

// Answers that the method gave up at t, with its budget spent; this is never counted as a miss.
Hit exhausted(Hit hit, real t) {
    hit.t = t;
    hit.status = EXHAUSTED;
    return hit;
}
