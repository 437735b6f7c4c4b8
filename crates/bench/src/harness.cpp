// Drives the verilated machine with the same triangles and the same memories as the model: for timing only.
// Usage: harness STIMULUS FRAMES CONSTANT ...
// Prints for each frame: cycles, writes, milliseconds on the processor, milliseconds on the wall.
// STIMULUS: little-endian 64-bit words, what is offered at the port, field by field: one triangle after the other, or one word of a triangle after the other. memory0.bin, memory1.bin ..: the words
// of the memories that the machine does not write, in 64 bits each, or in 128 where WIDE_WORDS is defined.
#include "Vmachine.h"
#include "verilated.h"
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

// A word of a memory.
#ifdef WIDE_WORDS
typedef unsigned __int128 Word;
#else
typedef uint64_t Word;
#endif

struct Read { uint64_t due; Word word; };

// A memory behind the machine. Beyond its words it is 0.
struct Memory {
    std::vector<Word> words;
    Read queue[64];
    uint64_t head = 0, tail = 0;
    bool due(uint64_t cycle) const { return head != tail && queue[head % 64].due <= cycle; }
    Word front() const { return queue[head % 64].word; }
    void pop() { ++head; }
    void read(size_t address, uint64_t when) {
        queue[tail % 64] = {when, address < words.size() ? words[address] : Word(0)};
        ++tail;
    }
    // Asks for the words of a pixel before they are needed. Triangles go down: the pixel below is likely to be next, as the model's memory says.
    void near(size_t address, const std::vector<uint64_t> &frame) const {
        __builtin_prefetch(words.data() + address);
        __builtin_prefetch(frame.data() + address);
    }
};

// Drives a port; Verilator gives those of more than 64 bits as arrays.
template <class Port> static inline void put(Port &port, Word word) { port = word; }
#ifdef WIDE_WORDS
template <size_t N> static inline void put(VlWide<N> &port, Word word) {
    for (size_t i = 0; i < N; ++i) port[i] = uint32_t(word >> (32 * i));
}
#endif

#include "ports.h"

template <class T> static std::vector<T> read_all(const char *name) {
    std::vector<T> words;
    FILE *file = std::fopen(name, "rb");
    if (!file) { std::perror(name); std::exit(3); }
    T word;
    while (std::fread(&word, sizeof word, 1, file) == 1) words.push_back(word);
    std::fclose(file);
    return words;
}

static double milliseconds(clockid_t clock) {
    timespec time;
    clock_gettime(clock, &time);
    return time.tv_sec * 1e3 + time.tv_nsec * 1e-6;
}

int main(int argc, char **argv) {
    if (argc < 3) { std::fprintf(stderr, "harness: 2 arguments and the constants\n"); return 3; }
    const auto words = read_all<uint64_t>(argv[1]);
    const int frames = std::atoi(argv[2]);
    static Memory memory[MEMORIES];
    std::vector<uint64_t> picture(PICTURE);
    for (size_t i = 0; i < MEMORIES; ++i)
        if (!WRITTEN[i]) memory[i].words = read_all<Word>(("memory" + std::to_string(i) + ".bin").c_str());
    Vmachine m;
    set_constants(m, argv + 3);
    always_ready(m);
    for (int frame = 0; frame < frames; ++frame) {
        const double cpu = milliseconds(CLOCK_PROCESS_CPUTIME_ID), wall = milliseconds(CLOCK_MONOTONIC);
        for (size_t i = 0; i < MEMORIES; ++i) {
            if (WRITTEN[i]) memory[i].words.assign(WORDS[i], CLEAR[i]);
            memory[i].head = memory[i].tail = 0;
        }
        std::fill(picture.begin(), picture.end(), 0);
        m.rst = 1; offer(m, nullptr); offer_words(m, memory, 0);
        m.clk = 0; m.eval(); m.clk = 1; m.eval();
        m.rst = 0;
        uint64_t cycle = 0, writes = 0;
        size_t next = 0;
        for (;;) {
            m.clk = 0;
            const bool offered = next + TOKEN <= words.size();
            offer(m, offered ? &words[next] : nullptr);
            offer_words(m, memory, cycle);
            m.eval();
            const bool taken = offered && takes(m);
            serve(m, memory, picture, cycle);
            writes += store(m, picture);
            ++cycle;
            const bool done = !offered && m.idle;
            m.clk = 1; m.eval();
            if (done) break;
            if (taken) next += TOKEN;
        }
        std::printf("%llu %llu %.6f %.6f\n", (unsigned long long)cycle, (unsigned long long)writes,
                    milliseconds(CLOCK_PROCESS_CPUTIME_ID) - cpu, milliseconds(CLOCK_MONOTONIC) - wall);
    }
    return 0;
}
