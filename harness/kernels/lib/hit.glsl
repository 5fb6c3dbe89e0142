// What a method answers for one ray: where, what, and how many evaluations of f it spent.
STRUCT(Hit) struct Hit { real t; int status; int evaluations; };

#define MISS 0
#define HIT 1
#define EXHAUSTED 2

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

// Gave up inside its budget at t; never a miss.
Hit exhausted(Hit hit, real t) {
    hit.t = t;
    hit.status = EXHAUSTED;
    return hit;
}
