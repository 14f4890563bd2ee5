# %% [markdown]
# # long-drives


# %% role="mistake" name="it stands" says="Drive."
def control(observation, memory):
    return 0.0, 0.4
