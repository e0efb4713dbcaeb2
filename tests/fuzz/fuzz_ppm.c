/* The input is a PPM file. */
#include "fuzz_support.h"

#include "ppm_io.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct image image;
    struct error err = {0};
    enum result result = ppm_read(fuzz_file(data, size), &image, &err);
    FUZZ_REQUIRE(strncmp(err.text, "out of memory", 13));
    FUZZ_REQUIRE(result == RESULT_OK ? image.channels == 3 : result == RESULT_DATA && *err.text && !image.pixels);
    for (int channel = 0; channel < image.channels; channel++)
        for (int y = 0; y < image.height; y++)
            for (int x = 0; x < image.width; x++)
                FUZZ_REQUIRE(image_row(&image, channel, y)[x] >= 0 && image_row(&image, channel, y)[x] <= 1);
    image_free(&image);
    return 0;
}
