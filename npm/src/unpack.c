/// Unpacks the solver: LZMA with lc = 3, lp = pb = 0 (pack.py). As wasm, because this runs once, and scripts are slow at first.
#include <stdint.h>

enum { MOST_PACKED = 1 << 16, MOST_UNPACKED = 1 << 18, STATES = 12, HALF = 1024 };

typedef uint16_t odds; ///< of a 0, in 2048ths

/// A length is 3 bits, 3 bits more or 8 bits.
typedef struct lengths {
    odds choice[2], low[8], middle[8], high[256];
} lengths;

static struct {
    odds is_match[STATES], is_again[4][STATES], is_long[STATES]; ///< is_again[0]: one of the last four distances
    odds literal[8][768], slot[4][64], special[128], align[16];
    lengths fresh, again;
} all;

static unsigned char packed[MOST_PACKED], unpacked[MOST_UNPACKED];
static const unsigned char *from;
static uint32_t range, value;

unsigned char *unpack_from(void) { return packed; }

static void normalise(void)
{
    if (range >> 24) return;
    range <<= 8;
    value = value << 8 | *from++;
}

static int bit(odds *odd)
{
    const uint32_t bound = (range >> 11) * *odd;
    const int set = value >= bound;
    if (set) {
        range -= bound, value -= bound, *odd -= *odd >> 5;
    } else {
        range = bound, *odd += (2048 - *odd) >> 5;
    }
    normalise();
    return set;
}

/// Bits from the highest on, each with odds by those before.
static int tree(odds *list, int count)
{
    int at = 1;
    for (int i = 0; i < count; i++) at = 2 * at + bit(list + at);
    return at - (1 << count);
}

/// Bits from the lowest on.
static int reverse(odds *list, int count)
{
    int at = 1, sum = 0;
    for (int i = 0; i < count; i++) {
        const int next = bit(list + at);
        at = 2 * at + next;
        sum += next << i;
    }
    return sum;
}

static int plain(int count)
{
    int sum = 0;
    for (; count > 0; count--) {
        range >>= 1;
        const int set = value >= range;
        if (set) value -= range;
        sum = 2 * sum + set;
        normalise();
    }
    return sum;
}

static int length(lengths *l)
{
    if (!bit(&l->choice[0])) return 2 + tree(l->low, 3);
    return !bit(&l->choice[1]) ? 10 + tree(l->middle, 3) : 18 + tree(l->high, 8);
}

static int distance(int count)
{
    const int slot = tree(all.slot[count < 5 ? count - 2 : 3], 6), bits = (slot >> 1) - 1;
    if (slot < 4) return slot + 1;
    const int base = (2 + (slot & 1)) << bits;
    if (slot < 14) return 1 + base + reverse(all.special + base - slot, bits);
    const int high = plain(bits - 4) << 4; // before the rest is read
    return 1 + base + high + reverse(all.align, 4);
}

/// A byte; after a match, with odds by the byte that the match would go on with.
static int literal(const unsigned char *to, int back, int after_match)
{
    odds *list = all.literal[to > unpacked ? to[-1] >> 5 : 0];
    int at = 1, like = after_match ? to[-back] : 0;
    for (; after_match && at < 256; like <<= 1) {
        const int expected = like >> 7 & 1, next = bit(list + 256 * (1 + expected) + at);
        at = 2 * at + next;
        if (next != expected) break;
    }
    while (at < 256) at = 2 * at + bit(list + at);
    return at;
}

/// `size` bytes of what is at unpack_from().
unsigned char *unpack(int size)
{
    int state = 0, back[4] = {1, 1, 1, 1};
    for (odds *odd = (odds *)&all; odd < (odds *)(&all + 1); odd++) *odd = HALF;
    range = UINT32_MAX, from = packed + 1, value = 0;
    for (int i = 0; i < 4; i++) value = value << 8 | *from++;
    for (unsigned char *to = unpacked, *end = to + size; to < end;) {
        int count = 0;
        if (!bit(&all.is_match[state])) {
            *to = (unsigned char)literal(to, back[0], state > 6);
            to++;
            state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
        } else if (!bit(&all.is_again[0][state])) {
            count = length(&all.fresh);
            back[3] = back[2], back[2] = back[1], back[1] = back[0];
            back[0] = distance(count);
            state = state < 7 ? 7 : 10;
        } else {
            const int same = !bit(&all.is_again[1][state]), once = same && !bit(&all.is_long[state]);
            if (!same) {
                const int which = bit(&all.is_again[2][state]) ? 2 + bit(&all.is_again[3][state]) : 1,
                          one = back[which];
                for (int i = which; i > 0; i--) back[i] = back[i - 1];
                back[0] = one;
            }
            count = once ? 1 : length(&all.again);
            state = (once ? 9 : 8) + (state < 7 ? 0 : once ? 2 : 3);
        }
        for (; count > 0 && to < end; count--, to++) *to = to[-back[0]];
    }
    return unpacked;
}
