# %% [markdown]
# # driven-control


# %% role="mistake" name="it is slow" says="Drive faster than 0.1 m/s."
def control(observation, memory):
    return 0.1, 0.0
