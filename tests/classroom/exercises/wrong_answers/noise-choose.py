# %% name="my_psnr of the cell above" sentence="my_psnr is defined in another cell: copy it into this cell, or import psnr from imgproc_course.imaging." must_say=["my_psnr", "cell|import"] kind="other-cell"
def best_filter(clean, noisy, filters):
    return max(filters, key=lambda name: my_psnr(clean, filters[name](noisy)))

# %% name="always median" sentence="The median wins against salt and pepper only, and here the name is typed in: apply each filter and compare the PSNR." must_say=["median|typed|hard|fixed|always", "PSNR|each|compare|every"] kind="value"
def best_filter(clean, noisy, filters):
    return "median 3"

# %% name="the value instead of the name" sentence="You return the highest PSNR; the task asks for the name of the filter that has it." must_say=["highest PSNR|the PSNR|value|score", "\\bname of|\\bname\\b", "You return the (highest|PSNR|value)|not the (value|PSNR|number)|asks"] kind="type"
from imgproc_course.imaging import psnr


def best_filter(clean, noisy, filters):
    return max(psnr(clean, f(noisy)) for f in filters.values())
