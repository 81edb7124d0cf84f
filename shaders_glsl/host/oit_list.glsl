// What blends, kept as a list a pixel until all of it is known (Yang et al. 2010, "Real-Time Concurrent Linked List
// Construction on the GPU"). Mirrored to Rust by build.rs.
#ifndef VAIR_OIT_LIST_GLSL
#define VAIR_OIT_LIST_GLSL

// A fragment in its pixel's list.
struct TransparencyEntry {
    uint next;                 // entry that was there before, counted from 1; 0 = none
    float depth;               // reversed, in the middle of the pixel
    uint slope;                // what it changes by a pixel to the right and down, over itself: two halves
    uint red;                  // packed channel; beside it the samples, a bit each
    uint green;                // packed channel; beside it the low bits of the rank
    uint blue;                 // packed channel; beside it the high bits of the rank
};

// Fragments of this frame, those among them that no entry was left for.
layout(set = 3, binding = 2, std430) buffer TransparencyCount { uint fragment_count; };
// The last entry of each pixel, row by row, counted from 1; 0 = none.
layout(set = 3, binding = 3, std430) buffer TransparencyHeads { uint heads[]; };
layout(set = 3, binding = 4, std430) buffer TransparencyEntries {
    uint width;                // pixels
    uint capacity;             // entries that there are
    TransparencyEntry entries[];
};

#endif
