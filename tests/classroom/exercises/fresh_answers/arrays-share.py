# %% name="counts the dark pixels" origin="fresh" sentence="You count the pixels that are not brighter than level: it must be gray > level." must_say=["> ?level|brighter|dark|opposite|revers|other|not brighter|<"] must_not_say=["share from 0 to 1|multiply by 100|times 100"] kind="value"
def bright_percent(gray, level):
    mask = gray < level
    return mask.sum() / gray.size * 100

# %% name="divides by 25" origin="fresh" sentence="You divide by 25, the size of the lesson's tiny image; divide by the number of pixels of the given image, gray.size." must_say=["25|size|number of pixels|mean"] must_not_say=["multiply by 100|times 100|share from 0 to 1"] kind="value"
def bright_percent(gray, level):
    bright = gray > level
    return bright.sum() * 100 / 25

# %% name="divides by the bright ones' values" origin="fresh" sentence="You add the gray levels of the bright pixels; count the pixels: (gray > level).mean() * 100." must_say=["count|number of|mean|pixels|sum"] must_not_say=[">=|equal"] kind="value"
def bright_percent(gray, level):
    values = gray[gray > level]
    return values.sum() / gray.sum() * 100

# %% name="rounds to a whole percent" origin="fresh" sentence="You round the result; the task asks for the exact float." must_say=["round|whole|exact|int|fraction"] must_not_say=["> ?=|equal to"] kind="value"
def bright_percent(gray, level):
    share = (gray > level).mean()
    return float(int(share * 100))

# %% name="len is rows" origin="fresh" sentence="len(gray) is only the number of rows; the number of pixels is gray.size." must_say=["number of (the )?rows|len|size|number of (all )?pixels|mean"] must_not_say=["> ?="] kind="value"
def bright_percent(gray, level):
    number = len(gray)
    return (gray > level).sum() / number * 100
