/* The input is a PNG file. */
#include "fuzz_support.h"

#include "png_io.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct image image;
    struct error err = {0};
    enum result result = png_read(fuzz_file(data, size), &image, &err);
    FUZZ_REQUIRE(strncmp(err.text, "out of memory", 13));
    FUZZ_REQUIRE(result == RESULT_OK ? image.channels == 3 : result == RESULT_DATA && *err.text && !image.pixels);
    for (int channel = 0; channel < image.channels; channel++)
        for (int y = 0; y < image.height; y++)
            for (int x = 0; x < image.width; x++)
                FUZZ_REQUIRE(image_row(&image, channel, y)[x] >= 0 && image_row(&image, channel, y)[x] <= 1);
    image_free(&image);
    return 0;
}

#ifdef FUZZ_MUTATOR
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);

static uint32_t get_number(const uint8_t *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* The CRC-32 of the PNG standard. */
static uint32_t crc_of(const uint8_t *data, size_t size)
{
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < size; i++) {
        crc ^= data[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc;
}

/* Most changes are followed by right check sums: without them libpng looks no further than these. */
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed)
{
    size = LLVMFuzzerMutate(data, size, max_size);
    for (size_t at = 8; seed % 8 && at + 12 <= size;) {
        uint32_t length = get_number(data + at);
        if (length > size - at - 12)
            break;
        uint32_t crc = crc_of(data + at + 4, length + 4);
        for (int i = 0; i < 4; i++)
            data[at + 8 + length + i] = (uint8_t)(crc >> (24 - 8 * i));
        at += 12 + length;
    }
    return size;
}
#endif
