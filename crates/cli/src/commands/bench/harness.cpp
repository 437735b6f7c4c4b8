// Drives the verilated machine with the same triangles and the same memory as the model: for timing only.
// Usage: harness STIMULUS LATENCY ADDRESS_BITS DEPTH_FUNC DEPTH_WRITE CLEAR_Z FRAMES
// Prints for each frame: cycles, writes, milliseconds on the processor, milliseconds on the wall.
// STIMULUS: little-endian 64-bit words: x y z r g b of three vertices, as at the port, EXTRA more behind each b.
#include "Vmachine.h"
#include "verilated.h"
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

static std::vector<int64_t> read_all(const char *name) {
    std::vector<int64_t> words;
    FILE *file = std::fopen(name, "rb");
    if (!file) { std::perror(name); std::exit(3); }
    int64_t word;
    while (std::fread(&word, sizeof word, 1, file) == 1) words.push_back(word);
    std::fclose(file);
    return words;
}

static double milliseconds(clockid_t clock) {
    timespec time;
    clock_gettime(clock, &time);
    return time.tv_sec * 1e3 + time.tv_nsec * 1e-6;
}

static const size_t vertex = 6 + EXTRA, triangle = 3 * vertex;

struct Read { uint64_t due; uint32_t z; };

int main(int argc, char **argv) {
    if (argc != 8) { std::fprintf(stderr, "harness: 7 arguments\n"); return 3; }
    const auto words = read_all(argv[1]);
    const uint64_t latency = std::strtoull(argv[2], nullptr, 10);
    const size_t size = size_t(1) << std::atoi(argv[3]);
    const int func = std::atoi(argv[4]), depth_write = std::atoi(argv[5]), frames = std::atoi(argv[7]);
    const uint32_t clear_z = uint32_t(std::strtoull(argv[6], nullptr, 10));
    std::vector<uint32_t> z(size);
    std::vector<uint64_t> rgb(size);
    Vmachine m;
    m.depth_func = func;
    m.depth_write = depth_write;
    m.rd_ready = 1;
    m.wr_ready = 1;
    for (int frame = 0; frame < frames; ++frame) {
        const double cpu = milliseconds(CLOCK_PROCESS_CPUTIME_ID), wall = milliseconds(CLOCK_MONOTONIC);
        std::fill(z.begin(), z.end(), clear_z);
        std::fill(rgb.begin(), rgb.end(), 0);
        m.rst = 1; m.tri_valid = 0; m.data_valid = 0;
        m.clk = 0; m.eval(); m.clk = 1; m.eval();
        m.rst = 0;
        Read queue[64];
        uint64_t head = 0, tail = 0, cycle = 0, writes = 0;
        size_t next = 0;
        for (;;) {
            m.clk = 0;
            const bool offered = next + triangle <= words.size();
            m.tri_valid = offered;
            if (offered) {
                const int64_t *v0 = &words[next], *v1 = v0 + vertex, *v2 = v1 + vertex;
                m.tri_x0 = v0[0]; m.tri_y0 = v0[1]; m.tri_z0 = v0[2]; m.tri_r0 = v0[3]; m.tri_g0 = v0[4]; m.tri_b0 = v0[5];
                m.tri_x1 = v1[0]; m.tri_y1 = v1[1]; m.tri_z1 = v1[2]; m.tri_r1 = v1[3]; m.tri_g1 = v1[4]; m.tri_b1 = v1[5];
                m.tri_x2 = v2[0]; m.tri_y2 = v2[1]; m.tri_z2 = v2[2]; m.tri_r2 = v2[3]; m.tri_g2 = v2[4]; m.tri_b2 = v2[5];
#if EXTRA > 0
                m.tri_e0_0 = v0[6]; m.tri_e0_1 = v1[6]; m.tri_e0_2 = v2[6];
#endif
#if EXTRA > 1
                m.tri_e1_0 = v0[7]; m.tri_e1_1 = v1[7]; m.tri_e1_2 = v2[7];
#endif
#if EXTRA > 2
                m.tri_e2_0 = v0[8]; m.tri_e2_1 = v1[8]; m.tri_e2_2 = v2[8];
#endif
#if EXTRA > 3
                m.tri_e3_0 = v0[9]; m.tri_e3_1 = v1[9]; m.tri_e3_2 = v2[9];
#endif
            }
            const bool data = head != tail && queue[head % 64].due <= cycle;
            m.data_valid = data;
            m.data_z = data ? queue[head % 64].z : 0;
            m.eval();
            const bool taken = offered && m.tri_ready;
            const bool read = m.rd_valid;
            const uint32_t address = m.rd_addr;
            if (data && m.data_ready) ++head;
            if (read) { queue[tail % 64] = {cycle + latency, z[address]}; ++tail; }
            if (m.wr_valid) {
                if (m.wr_z_en) z[m.wr_addr] = m.wr_z;
                rgb[m.wr_addr] = uint64_t(m.wr_r) << 32 | uint64_t(m.wr_g) << 16 | m.wr_b;
                ++writes;
            }
            ++cycle;
            const bool done = !offered && m.idle;
            m.clk = 1; m.eval();
            if (done) break;
            if (taken) next += triangle;
        }
        std::printf("%llu %llu %.6f %.6f\n", (unsigned long long)cycle, (unsigned long long)writes,
                    milliseconds(CLOCK_PROCESS_CPUTIME_ID) - cpu, milliseconds(CLOCK_MONOTONIC) - wall);
    }
    return 0;
}
